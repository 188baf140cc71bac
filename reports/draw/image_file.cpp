// The OpenImageIO shim: no type of its leaves this file, and no exception.
#include "image_file.h"

#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

extern "C" {
#include "base/file.h"
#include "image/colour.h"
}

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
    } catch (const std::bad_alloc &) {
        return fm_fail(err, FM_NO_MEMORY, "%s", what);
    } catch (const std::exception &problem) {
        return fm_fail(err, FM_IO, "%s: OpenImageIO: %s", what, problem.what());
    }
}

bool is_srgb(const OIIO::ImageSpec &spec, fm_transfer transfer)
{
    if (transfer == FM_TRANSFER_BY_FORMAT)
        return !spec.format.is_floating_point();
    return transfer == FM_TRANSFER_SRGB;
}

// How a file's channels become RGBA.
struct coding {
    int channels;
    bool is_srgb, is_premultiplied;
};

void decode(float *rgba, const float *file, const coding &coded)
{
    const bool is_grey = coded.channels < 3;
    const float alpha = coded.channels % 2 == 0 ? file[coded.channels - 1] : 1.0F;
    for (int c = 0; c < 3; c++) {
        const double value = file[is_grey ? 0 : c];
        rgba[c] = static_cast<float>(coded.is_srgb ? srgb_to_linear(value) : value) *
                  (coded.is_premultiplied ? 1.0F : alpha);
    }
    rgba[3] = alpha;
}

fm_status read_pixels(fm_image *image, OIIO::ImageInput &input, const char *path,
                      fm_transfer transfer, fm_error *err)
{
    const OIIO::ImageSpec &spec = input.spec();
    const bool has_alpha = spec.nchannels % 2 == 0;
    const coding coded = { spec.nchannels, is_srgb(spec, transfer),
                           !has_alpha || spec.get_int_attribute("oiio:UnassociatedAlpha") == 0 };
    const std::size_t channels = static_cast<std::size_t>(spec.nchannels);
    const std::size_t pixels = std::size_t{ image->width_px } * image->height_px;
    std::vector<float> values(channels * pixels);
    if (!input.read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data()))
        return fm_fail(err, FM_INVALID, "%s: %s", path, input.geterror().c_str());
    for (std::size_t i = 0; i < pixels; i++)
        decode(image->rgba + 4 * i, values.data() + channels * i, coded);
    return FM_OK;
}

fm_status read_image(fm_image **image, const char *path, fm_transfer transfer, fm_error *err)
{
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1); // colours are linear before they are multiplied
    auto input = OIIO::ImageInput::open(path, &config);
    if (!input)
        return fm_fail(err, FM_INVALID, "%s: %s", path, OIIO::geterror().c_str());
    const OIIO::ImageSpec &spec = input->spec();
    if (spec.nchannels < 1 || spec.nchannels > 4 || spec.depth > 1 || spec.deep)
        return fm_fail(err, FM_INVALID, "%s: %d channels%s: only flat images of 1 to 4 are read",
                       path, spec.nchannels, spec.deep || spec.depth > 1 ? ", deep" : "");
    fm_status status = image_create(image, static_cast<std::uint32_t>(spec.width),
                                    static_cast<std::uint32_t>(spec.height), err);
    if (status != FM_OK)
        return fm_error_prefix(err, path);
    status = read_pixels(*image, *input, path, transfer, err);
    if (status != FM_OK) {
        image_destroy(*image);
        *image = nullptr;
    }
    return status;
}

OIIO::ImageBuf shown(const fm_image *image)
{
    OIIO::ImageBuf buffer(OIIO::ImageSpec(static_cast<int>(image->width_px),
                                          static_cast<int>(image->height_px), 3,
                                          OIIO::TypeDesc::FLOAT));
    for (std::uint32_t y = 0; y < image->height_px; y++)
        for (std::uint32_t x = 0; x < image->width_px; x++) {
            const float *rgba = image->rgba + (std::size_t{ y } * image->width_px + x) * 4;
            const float rgb[3] = { rgba[0] + 1.0F - rgba[3], rgba[1] + 1.0F - rgba[3],
                                   rgba[2] + 1.0F - rgba[3] };
            buffer.setpixel(static_cast<int>(x), static_cast<int>(y), rgb);
        }
    return buffer;
}

} // namespace

fm_status image_file_read(fm_image **image, const char *path, fm_transfer transfer, fm_error *err)
{
    FILE *file = nullptr;
    *image = nullptr;
    const fm_status status = file_open_stream(&file, path, err); // says what is no regular file
    if (status != FM_OK)
        return status;
    std::fclose(file);
    return guard(path, err, [&] { return read_image(image, path, transfer, err); });
}

fm_status image_file_yee(uint64_t *pixels, const fm_image *image, const fm_image *reference,
                         fm_error *err)
{
    return guard("Yee's metric", err, [&] {
        OIIO::ImageBufAlgo::CompareResults results;
        *pixels = static_cast<std::uint64_t>(
            OIIO::ImageBufAlgo::compare_Yee(shown(image), shown(reference), results));
        return FM_OK;
    });
}

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

static fm_status write_floats(const char *path, const float *values, uint32_t width_px,
                              uint32_t height_px, int channels, fm_error *err)
{
    return guard(path, err, [&] {
        OIIO::ImageSpec spec(static_cast<int>(width_px), static_cast<int>(height_px), channels,
                             OIIO::TypeDesc::FLOAT);
        spec.attribute("compression", "zip");
        return write(path, spec, values, err);
    });
}

fm_status image_file_write_rgba32f(const char *path, const float *rgba, uint32_t width_px,
                                   uint32_t height_px, fm_error *err)
{
    return write_floats(path, rgba, width_px, height_px, 4, err);
}

fm_status image_file_write_grey32f(const char *path, const float *values, uint32_t width_px,
                                   uint32_t height_px, fm_error *err)
{
    return write_floats(path, values, width_px, height_px, 1, err);
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
