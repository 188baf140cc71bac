// The OpenImageIO shim: no type of its leaves this file, and no exception.
#include "image_file.h"

#include <exception>
#include <memory>
#include <string>

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

namespace
{

fm_status write(const char *path, const OIIO::ImageSpec &spec, const void *pixels, fm_error *err)
{
    auto output = OIIO::ImageOutput::create(path);
    if (!output)
        return fm_fail(err, FM_IO, "%s: %s", path, OIIO::geterror().c_str());
    if (!output->open(path, spec) || !output->write_image(spec.format, pixels) || !output->close())
        return fm_fail(err, FM_IO, "%s: %s", path, output->geterror().c_str());
    return FM_OK;
}

template <typename Work> fm_status guard(const char *what, fm_error *err, Work work)
{
    try {
        return work();
    } catch (const std::exception &problem) {
        return fm_fail(err, FM_IO, "%s: OpenImageIO: %s", what, problem.what());
    }
}

} // namespace

fm_status image_file_write_rgb8(const char *path, const uint8_t *pixels, uint32_t width_px,
                                uint32_t height_px, fm_error *err)
{
    return guard(path, err, [&] {
        OIIO::ImageSpec spec(static_cast<int>(width_px), static_cast<int>(height_px), 3,
                             OIIO::TypeDesc::UINT8);
        spec.attribute("oiio:ColorSpace", "sRGB");
        return write(path, spec, pixels, err);
    });
}

fm_status image_file_write_rgba32f(const char *path, const float *rgba, uint32_t width_px,
                                   uint32_t height_px, fm_error *err)
{
    return guard(path, err, [&] {
        OIIO::ImageSpec spec(static_cast<int>(width_px), static_cast<int>(height_px), 4,
                             OIIO::TypeDesc::FLOAT);
        spec.attribute("compression", "zip");
        return write(path, spec, rgba, err);
    });
}

fm_status image_file_heat(uint8_t *rgb, const float *shares, uint32_t count, fm_error *err)
{
    return guard("heat map", err, [&] {
        const int width = static_cast<int>(count);
        OIIO::ImageBuf source(OIIO::ImageSpec(width, 1, 1, OIIO::TypeDesc::FLOAT));
        source.set_pixels(OIIO::ROI::All(), OIIO::TypeDesc::FLOAT, shares);
        OIIO::ImageBuf heat = OIIO::ImageBufAlgo::color_map(source, 0, "inferno");
        const OIIO::ROI all(0, width, 0, 1, 0, 1, 0, 3);
        if (heat.has_error() || !heat.get_pixels(all, OIIO::TypeDesc::UINT8, rgb))
            return fm_fail(err, FM_IO, "heat map: %s", heat.geterror().c_str());
        return FM_OK;
    });
}
