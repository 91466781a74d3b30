/* SPDX-License-Identifier: MIT
 *
 * Writes a picture in any format that OpenImageIO knows (EXR, HDR, TIFF, JPEG ...). It has no C
 * interface, so this one file is C++17; it is built only where the library was found. */
#include "image.h"

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>

extern "C" int image_write_oiio(const char *path, const image *picture) {
    try {
        const auto output = OIIO::ImageOutput::create(path);
        if (!output) {
            std::fprintf(stderr, "%s\n", OIIO::geterror().c_str());
            return 1;
        }
        const std::string format = output->format_name();
        const bool stores_floats = format == "openexr" || format == "hdr";
        OIIO::ImageSpec spec(picture->width, picture->height, picture->channels,
                             stores_floats ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
        spec.channelnames = picture->channels == 3 ? std::vector<std::string>{"R", "G", "B"}
                                                   : std::vector<std::string>{"Y"};
        std::vector<float> pixels(picture->pixels,
                                  picture->pixels + spec.image_pixels() * spec.nchannels);
        if (!stores_floats) {
            for (float &value : pixels) value = float(image_srgb_byte(value)) / 255.0f;
        }
        if (!output->open(path, spec) ||
            !output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) || !output->close()) {
            std::fprintf(stderr, "%s\n", output->geterror().c_str());
            return 1;
        }
        return 0;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "%s: %s\n", path, error.what());
        return 1;
    } catch (...) {
        return 1;
    }
}
