/* SPDX-License-Identifier: MIT
 *
 * Rows Q5 to Q7 and Q12 for scenes: a ray gives the same bits in any company, order, width and
 * layout, beside any components that it cannot meet, and at any power of two of scale. */
#include "scene_draw.h"
#include "scene_views.h"
#include "harness.h"
#include "../check.h"
#include "../rules.h"

#include <math.h>
#include <string.h>

enum { crowd = 1300, unmet_most = 60 };

static scene_ray rays[crowd], mixed[crowd];
static spt_hit alone[crowd], hits[crowd];
static size_t from[crowd];

static void check_same(size_t count, const spt_hit *expected, const spt_hit *seen) {
    for (size_t i = 0; i < count; ++i) {
        CHECK_SAY(oracle_same_hit(&expected[i], &seen[i]),
                  "ray %lu: outcome %d and %d, t %.9g and %.9g, evaluations %u and %u, component "
                  "%d and %d",
                  (unsigned long)i, expected[i].outcome, seen[i].outcome, (double)expected[i].t,
                  (double)seen[i].t, expected[i].evaluations, seen[i].evaluations,
                  expected[i].component, seen[i].component);
    }
}

/* ---- Company ------------------------------------------------------------------------------- */

/* A quarter of the rays is junk: any bits, and often the worst. */
static void spoil(scene_ray *self) {
    static const uint32_t worst[] = {0x7fc00000u, 0x7f800000u, 0xff800000u, 0x00000001u,
                                     0x7f7fffffu, 0x80000000u, 0u,          0x7f800001u};
    float *numbers[9] = {&self->ray.origin[0],    &self->ray.origin[1],    &self->ray.origin[2],
                         &self->ray.direction[0], &self->ray.direction[1], &self->ray.direction[2],
                         &self->ray.t_min,        &self->ray.t_max,        &self->path};
    for (uint32_t i = 1 + check_random() % 3; i > 0; --i) {
        const uint32_t bits = check_random() % 4 == 0 ? check_random() : worst[check_random() % 8];
        memcpy(numbers[check_random() % 9], &bits, sizeof bits);
    }
}

/* A random order of the rays, some of them inactive with nothing but NaN in them. */
static void mix(void) {
    for (size_t i = 0; i < crowd; ++i) from[i] = i;
    for (size_t i = crowd - 1; i > 0; --i) {
        const size_t other = check_random() % (uint32_t)(i + 1), kept = from[i];
        from[i] = from[other];
        from[other] = kept;
    }
    for (size_t i = 0; i < crowd; ++i) {
        mixed[i] = rays[from[i]];
        if (check_random() % 8 != 0) continue;
        memset(&mixed[i], 0xff, sizeof mixed[i]);
        mixed[i].active = 0;
    }
}

static void check_mixed(void) {
    spt_hit untouched;
    memset(&untouched, 0xa5, sizeof untouched);
    for (size_t i = 0; i < crowd; ++i) {
        const spt_hit *expected = mixed[i].active != 0 ? &alone[from[i]] : &untouched;
        if (mixed[i].active == 0) {
            CHECK(memcmp(&hits[i], &untouched, sizeof untouched) == 0);
        } else {
            check_same(1, expected, &hits[i]);
        }
    }
}

/* Each ray alone on one lane is what the same ray must be in calls of any size. */
static void check_company(const spt_scene *united, const spt_settings *chosen) {
    static const size_t sizes[] = {7, 255, 256, 257, 1000, crowd};
    spt_settings settings = *chosen;
    settings.max_lanes = 1;
    for (size_t i = 0; i < crowd; ++i) scene_run(united, &settings, 1, &rays[i], &alone[i]);
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; ++i) {
        settings.max_lanes = widths[(i + check_random()) % width_count];
        mix();
        memset(hits, 0xa5, sizeof hits);
        for (size_t first = 0; first < crowd; first += sizes[i]) {
            const size_t count = crowd - first < sizes[i] ? crowd - first : sizes[i];
            scene_run(united, &settings, count, &mixed[first], &hits[first]);
        }
        check_mixed();
    }
}

static void Q12_scene_company_changes_nothing(void) {
    static drawn_scene made;
    for (int draw = 0; draw < 2; ++draw) {
        spt_settings settings = scene_draw_settings();
        scene_draw(&made, draw == 0 ? 3 : drawn_components, DRAW_UNITED | DRAW_FAULTS);
        scene_draw_zones(&made);
        settings.budget = 200;
        for (size_t i = 0; i < crowd; ++i) {
            rays[i] = scene_draw_ray();
            if (i % 4 == 3) spoil(&rays[i]);
        }
        for (scene_rules walk = scene_first_rule(&made.scene, "a random scene");
             scene_next_rule(&walk);) {
            settings.method = walk.method;
            check_company(&made.scene, &settings);
        }
    }
}

static void Q12_shared_scenes_company(void) {
    static scene_parts parts;
    static scene_ray all[view_rays];
    for (scene_view view = scene_first_view; scene_next_view(&view);) {
        spt_settings settings = spt_settings_default();
        settings.pixel_radius = scene_view_rays(view.shown, all);
        memcpy(rays, &all[view_rays - crowd], sizeof rays);
        scene_parts_of(view.shown, view.grain, spt_lanes(), &parts);
        check_company(&parts.scene, &settings);
    }
}

/* Thousands of rays at once, many of them waiting for the same component. */
static void Q12_scene_one_large_call(void) {
    enum { many = 5000 };
    static drawn_scene made;
    static scene_ray all[many];
    static spt_hit small[many], large[many];
    spt_settings settings = scene_draw_settings();
    scene_draw(&made, 10, DRAW_UNITED);
    for (size_t i = 0; i < many; ++i) all[i] = scene_draw_ray();
    for (scene_rules walk = scene_first_rule(&made.scene, "5000 rays"); scene_next_rule(&walk);) {
        settings.method = walk.method;
        scene_run(&made.scene, &settings, many, all, large);
        for (size_t first = 0; first < many; first += 100) {
            scene_run(&made.scene, &settings, 100, &all[first], &small[first]);
        }
        check_same(many, small, large);
    }
}

/* ---- Layout -------------------------------------------------------------------------------- */

typedef struct columns {
    float origin[3][crowd], direction[3][crowd], t_min[crowd], t_max[crowd], path[crowd];
    int32_t active[crowd];
    spt_rays rays;
} columns;

/* Separate arrays, forwards or backwards in memory. */
static spt_column column_of(const void *first, int backwards) {
    spt_column column;
    column.first = backwards ? (const char *)first + (crowd - 1) * sizeof(float) : first;
    column.stride = backwards ? -(ptrdiff_t)sizeof(float) : (ptrdiff_t)sizeof(float);
    return column;
}

static void separate(columns *self, int backwards) {
    for (size_t i = 0; i < crowd; ++i) {
        const size_t place = backwards ? crowd - 1 - i : i;
        for (int axis = 0; axis < 3; ++axis) {
            self->origin[axis][place] = rays[i].ray.origin[axis];
            self->direction[axis][place] = rays[i].ray.direction[axis];
        }
        self->t_min[place] = rays[i].ray.t_min;
        self->t_max[place] = rays[i].ray.t_max;
        self->path[place] = rays[i].path;
        self->active[place] = -1;
    }
    for (int axis = 0; axis < 3; ++axis) {
        self->rays.origin[axis] = column_of(self->origin[axis], backwards);
        self->rays.direction[axis] = column_of(self->direction[axis], backwards);
    }
    self->rays.t_min = column_of(self->t_min, backwards);
    self->rays.t_max = column_of(self->t_max, backwards);
    self->rays.path = column_of(self->path, backwards);
    self->rays.active = column_of(self->active, backwards);
}

static spt_sink *sink_of(spt_hits *sinks, int index) {
    spt_sink *const all[9] = {&sinks->t,           &sinks->residual,        &sinks->outcome,
                              &sinks->evaluations, &sinks->flags,           &sinks->component,
                              &sinks->candidate_t, &sinks->candidate_ratio, &sinks->fallbacks};
    return all[index];
}

/* Where a result lies in a spt_hit is where its sink is in spt_hits. */
static void check_sink(int index, const uint32_t *column) {
    for (size_t i = 0; i < crowd; ++i) {
        uint32_t expected[9];
        memcpy(expected, &alone[i], sizeof expected);
        CHECK_SAY(column[i] == expected[index], "result %d of ray %lu: %08x and %08x", index,
                  (unsigned long)i, expected[index], column[i]);
    }
}

/* Separate arrays for rays and results, and each result as the only one wanted. */
static void Q12_scene_layout(void) {
    static drawn_scene made;
    static columns apart;
    static uint32_t results[9][crowd];
    spt_settings settings = scene_draw_settings();
    scene_draw(&made, 12, DRAW_UNITED);
    scene_draw_zones(&made);
    for (size_t i = 0; i < crowd; ++i) rays[i] = scene_draw_ray();
    for (int way = 0; way < 11; ++way) {
        spt_hits sinks;
        memset(&sinks, 0, sizeof sinks);
        settings.max_lanes = widths[way % width_count];
        scene_run(&made.scene, &settings, crowd, rays, alone);
        separate(&apart, way % 2);
        for (int index = 0; index < 9; ++index) {
            if (way < 9 && index != way) continue;
            sink_of(&sinks, index)->first = results[index];
            sink_of(&sinks, index)->stride = sizeof(uint32_t);
        }
        scene_call(&made.scene, &settings, crowd, &apart.rays, &sinks, NULL);
        for (int index = 0; index < 9; ++index) {
            if (way >= 9 || index == way) check_sink(index, results[index]);
        }
    }
}

/* ---- Components that cannot be met ---------------------------------------------------------- */

static int asked_unmet;

static float unmet_value(void *user, float x, float y, float z) {
    (void)user;
    (void)x;
    (void)y;
    (void)z;
    ++asked_unmet;
    return -1;
}

/* A bound beyond every t_max: rays begin within 12 of the origin and end within 60 of there. */
static spt_bound unmet_bound(void) {
    const float at = 200 + (float)check_uniform(0, 1000);
    return check_random() % 2 == 0 ? spt_bound_sphere(at, at, -at, 20)
                                   : spt_bound_box(-at, at, -at, at, at + 5, at);
}

static void Q12_scene_components_not_met(void) {
    static drawn_scene made;
    static spt_field fields[drawn_components + unmet_most];
    static spt_bound bounds[unmet_most];
    for (int draw = 0; draw < 6; ++draw) {
        spt_settings settings = scene_draw_settings();
        spt_scene larger = spt_scene_default();
        int32_t place[drawn_components];
        size_t unmet = 0, met = 0;
        scene_draw(&made, 1 + check_random() % drawn_components, DRAW_UNITED);
        while (met < made.scene.count) {
            if (unmet < unmet_most && check_random() % 2 == 0) {
                spt_field *field = &fields[larger.count++];
                bounds[unmet] = unmet_bound();
                *field = spt_field_default();
                field->point = unmet_value;
                field->bound = &bounds[unmet++];
            } else {
                place[met] = (int32_t)larger.count;
                fields[larger.count++] = made.fields[met++];
            }
        }
        larger.fields = fields;
        asked_unmet = 0;
        for (size_t i = 0; i < crowd; ++i) rays[i] = scene_draw_plain_ray();
        for (scene_rules walk = scene_first_rule(&made.scene, "unmet"); scene_next_rule(&walk);) {
            settings.method = walk.method;
            scene_run(&made.scene, &settings, crowd, rays, alone);
            settings.max_lanes = widths[check_random() % width_count];
            scene_run(&larger, &settings, crowd, rays, hits);
            for (size_t i = 0; i < crowd; ++i) {
                if (alone[i].component >= 0) alone[i].component = place[alone[i].component];
            }
            check_same(crowd, alone, hits);
        }
        CHECK(asked_unmet == 0);
    }
}

/* ---- Scale --------------------------------------------------------------------------------- */

/* What was traced, and what changes in a hit when it is scaled. */
static void check_scaled(const spt_scene *plain, const spt_settings *settings,
                         const spt_scene *scaled, const spt_settings *scaled_settings, int t_power,
                         int residual_power) {
    scene_run(plain, settings, crowd, rays, alone);
    scene_run(scaled, scaled_settings, crowd, mixed, hits);
    for (size_t i = 0; i < crowd; ++i) {
        alone[i].t = ldexpf(alone[i].t, t_power);
        alone[i].candidate_t = ldexpf(alone[i].candidate_t, t_power);
        alone[i].residual = ldexpf(alone[i].residual, residual_power);
    }
    check_same(crowd, alone, hits);
}

/* kind 5: all lengths, 6: the directions, 7: the fields' values, as the rows. */
static void scaled_scenes(int kind) {
    static drawn_scene made, scaled;
    for (int draw = 0; draw < 8; ++draw) {
        const int power = (int)(check_random() % 81) - 40;
        const int lengths = kind == 5 ? power : 0, directions = kind == 6 ? power : 0;
        spt_settings settings = scene_draw_settings(), scaled_settings;
        scene_draw(&made, 1 + check_random() % 20, DRAW_UNITED);
        scene_draw_zones(&made);
        scene_scaled(&made, lengths, &scaled);
        for (size_t i = 0; kind == 7 && i < made.scene.count; ++i) {
            scaled.components[i].factor = ldexpf(scaled.components[i].factor, power);
            scaled.fields[i].lipschitz = scaled.components[i].factor;
        }
        for (size_t i = 0; i < crowd; ++i) {
            spt_ray *ray = &mixed[i].ray;
            rays[i] = scene_draw_ray();
            if (!(rays[i].ray.t_max <= FLT_MAX)) rays[i].ray.t_max = 60; /* not where floats end */
            mixed[i] = rays[i];
            mixed[i].path = ldexpf(mixed[i].path, lengths);
            ray->t_min = ldexpf(ray->t_min, lengths - directions);
            ray->t_max = ldexpf(ray->t_max, lengths - directions);
            for (int axis = 0; axis < 3; ++axis) {
                ray->origin[axis] = ldexpf(ray->origin[axis], lengths);
                ray->direction[axis] = ldexpf(ray->direction[axis], directions);
            }
        }
        for (scene_rules walk = scene_first_rule(&made.scene, "scaled"); scene_next_rule(&walk);) {
            settings.method = walk.method;
            settings.max_lanes = widths[check_random() % width_count];
            scaled_settings = settings;
            scaled_settings.epsilon = ldexpf(settings.epsilon, lengths);
            scaled_settings.size = ldexpf(settings.size, lengths);
            check_scaled(&made.scene, &settings, &scaled.scene, &scaled_settings,
                         lengths - directions, kind == 6 ? 0 : power);
        }
    }
}

static void Q5_scene_lengths_scaled(void) {
    scaled_scenes(5);
}

static void Q6_scene_directions_scaled(void) {
    scaled_scenes(6);
}

static void Q7_scene_values_scaled(void) {
    scaled_scenes(7);
}

void suite_scene_company(void) {
    RUN(Q12_scene_company_changes_nothing);
    RUN(Q12_shared_scenes_company);
    RUN(Q12_scene_one_large_call);
    RUN(Q12_scene_layout);
    RUN(Q12_scene_components_not_met);
    RUN(Q5_scene_lengths_scaled);
    RUN(Q6_scene_directions_scaled);
    RUN(Q7_scene_values_scaled);
}
