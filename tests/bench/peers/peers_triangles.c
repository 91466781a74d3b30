/* SPDX-License-Identifier: MIT
 *
 * The bodies of the village as triangles, their surfaces exactly: boxes for ground and walls, a
 * prism for each roof with its eaves. */
#include "peers_embree.h"

#include <string.h>

enum {
    BOX_CORNERS = 8,
    BOX_FACES = 12,
    PRISM_CORNERS = 6,
    PRISM_FACES = 8,
    CORNERS = VILLAGE_HOUSES * (BOX_CORNERS + PRISM_CORNERS) + BOX_CORNERS,
    FACES = VILLAGE_HOUSES * (BOX_FACES + PRISM_FACES) + BOX_FACES
};

typedef struct triangles {
    float (*corners)[3];
    unsigned (*faces)[3];
    unsigned corner_count, face_count;
} triangles;

/* Corner k of a box: bit 0 the side across, bit 1 up, bit 2 along. */
static const unsigned box_faces[BOX_FACES][3] = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5},
                                                 {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                                 {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};

/* Corners 0 left, 1 right, 2 ridge of the gable at the back, 3 to 5 of that in front. */
static const unsigned prism_faces[PRISM_FACES][3] = {{0, 2, 1}, {3, 4, 5}, {0, 3, 5}, {0, 5, 2},
                                                     {1, 2, 5}, {1, 5, 4}, {0, 1, 4}, {0, 4, 3}};

static void add_faces(triangles *mesh, const unsigned (*faces)[3], unsigned count) {
    for (unsigned i = 0; i < count; ++i) {
        for (int k = 0; k < 3; ++k) {
            mesh->faces[mesh->face_count][k] = mesh->corner_count + faces[i][k];
        }
        ++mesh->face_count;
    }
}

/* A point as a house sees it. */
static void add_corner(triangles *mesh, const village_house *house, double across, double height,
                       double along) {
    const double cosine = (double)house->cosine, sine = (double)house->sine;
    float *const corner = mesh->corners[mesh->corner_count++];
    corner[0] = (float)((double)house->x + cosine * across - sine * along);
    corner[1] = (float)height;
    corner[2] = (float)((double)house->z + sine * across + cosine * along);
}

static void add_box(triangles *mesh, const village_house *house, double half_width, double low,
                    double high, double half_depth) {
    add_faces(mesh, box_faces, BOX_FACES);
    for (int k = 0; k < BOX_CORNERS; ++k) {
        add_corner(mesh, house, k & 1 ? half_width : -half_width, k & 2 ? high : low,
                   k & 4 ? half_depth : -half_depth);
    }
}

/* The roof's slopes meet its underside where (ridge - top of the walls) is used up. */
static void add_roof(triangles *mesh, const village_house *house) {
    const double top = 2 * (double)house->half_height, ridge = (double)house->ridge;
    const double half_width = (ridge - top) * VILLAGE_ROOF_UP / VILLAGE_ROOF_ACROSS;
    const double half_depth = (double)house->half_depth + VILLAGE_EAVES;
    add_faces(mesh, prism_faces, PRISM_FACES);
    for (int end = -1; end <= 1; end += 2) {
        add_corner(mesh, house, -half_width, top, end * half_depth);
        add_corner(mesh, house, half_width, top, end * half_depth);
        add_corner(mesh, house, 0, ridge, end * half_depth);
    }
}

void peers_add_triangles(RTCDevice device, RTCScene world) {
    static const village_house nowhere = {0, 0, 1, 0, 0, 0, 0, 0};
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    triangles mesh;
    memset(&mesh, 0, sizeof mesh);
    mesh.corners = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           sizeof *mesh.corners, CORNERS);
    mesh.faces = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                         sizeof *mesh.faces, FACES);
    for (int i = 0; i < VILLAGE_HOUSES; ++i) {
        const village_house *const house = &village_houses[i];
        add_box(&mesh, house, (double)house->half_width, 0, 2 * (double)house->half_height,
                (double)house->half_depth);
        add_roof(&mesh, house);
    }
    add_box(&mesh, &nowhere, VILLAGE_GROUND_HALF, -2 * VILLAGE_GROUND_DEPTH, 0,
            VILLAGE_GROUND_HALF);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(world, geometry);
    rtcReleaseGeometry(geometry);
}
