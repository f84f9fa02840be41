/* The module lightsheaf-openimageio: files in memory to pixels in memory and back. No exception
 * leaves this file. */
#include "io/image_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstdlib>
#include <cstring>
#include <exception>
#include <vector>

namespace
{

const char *const plugin_names[] = {"png", "jpeg", "hdr", "openexr"};
const char *const file_kinds[] = {"PNG", "JPEG", "HDR", "EXR"};

bool decode_failed(const char *name, lsf_image_file file, const std::string &cause,
                   lsf_error *error)
{
    size_t end = cause.find_last_not_of("\n ");
    return lsf_error_set(error, LSF_ERROR_FILE,
                         "%s: the %s file is damaged or cut short (%s); save or copy it again",
                         name, file_kinds[file],
                         end == std::string::npos ? "no cause given"
                                                  : cause.substr(0, end + 1).c_str());
}

size_t texel_size(lsf_texel_type type)
{
    return type == LSF_TEXEL_F32 ? 4 : type == LSF_TEXEL_U16 ? 2 : 1;
}

/* OpenImageIO scales integers to 0..1 when it converts them to float; an id is to stay what it
 * is. */
void undo_integer_scale(lsf_decoded_image *decoded, const OIIO::ImageSpec &spec)
{
    float *texels = static_cast<float *>(decoded->texels);
    size_t count = static_cast<size_t>(decoded->width) * decoded->height;
    for (uint32_t c = 0; c < decoded->channels; c++)
        if (spec.channelformat(static_cast<int>(c)) == OIIO::TypeUInt32)
            for (size_t i = 0; i < count; i++)
                texels[i * decoded->channels + c] *= 4294967295.0f;
}

bool decode_unguarded(lsf_decoded_image *decoded, const lsf_image_header *header, const void *bytes,
                      size_t length, const char *name, lsf_error *error)
{
    /* create() with a format's name: open() would go on to try every other reader on a file that
     * the right one refuses. */
    auto input = OIIO::ImageInput::create(plugin_names[header->file]);
    if (!input)
        return decode_failed(name, header->file, OIIO::geterror(), error);
    OIIO::Filesystem::IOMemReader reader(bytes, length);
    OIIO::ImageSpec config, spec;
    config.attribute("oiio:UnassociatedAlpha", 1);
    if (!input->set_ioproxy(&reader) || !input->open("memory", spec, config))
        return decode_failed(name, header->file, input->geterror(), error);
    if (spec.width != static_cast<int>(header->width) ||
        spec.height != static_cast<int>(header->height) || spec.depth > 1 || spec.deep ||
        spec.nchannels < 1 || spec.nchannels > static_cast<int>(header->channels))
        return decode_failed(name, header->file, "its header contradicts itself", error);

    decoded->width = header->width;
    decoded->height = header->height;
    decoded->channels = static_cast<uint32_t>(spec.nchannels);
    decoded->type = header->type;
    decoded->texels = lsf_alloc(static_cast<uint64_t>(decoded->width) * decoded->height,
                                decoded->channels * texel_size(decoded->type));
    decoded->names = static_cast<char(*)[LSF_CHANNEL_NAME_SIZE]>(
        lsf_alloc(decoded->channels, LSF_CHANNEL_NAME_SIZE));
    if (!decoded->texels || !decoded->names)
        return lsf_error_set(error, LSF_ERROR_FILE, "%s: not enough memory for %u x %u pixels",
                             name, decoded->width, decoded->height);
    for (uint32_t c = 0; c < decoded->channels; c++)
        spec.channelnames[c].copy(decoded->names[c], LSF_CHANNEL_NAME_SIZE - 1);

    OIIO::TypeDesc type = decoded->type == LSF_TEXEL_F32   ? OIIO::TypeFloat
                          : decoded->type == LSF_TEXEL_U16 ? OIIO::TypeUInt16
                                                           : OIIO::TypeUInt8;
    /* Without a conversion, OpenImageIO reads in place; for one it takes 64 MiB, however small the
     * picture. */
    if (spec.format == type && spec.channelformats.empty())
        type = OIIO::TypeUnknown;
    bool read = input->read_image(0, 0, 0, spec.nchannels, type, decoded->texels);
    /* libjpeg only warns about damaged data; OpenImageIO keeps the warning as a pending error. */
    if (!read || input->has_error())
        return decode_failed(name, header->file, input->geterror(), error);
    if (decoded->type == LSF_TEXEL_F32)
        undo_integer_scale(decoded, spec);
    return true;
}

bool decode(lsf_decoded_image *decoded, const lsf_image_header *header, const void *bytes,
            size_t length, const char *name, lsf_error *error)
{
    std::memset(decoded, 0, sizeof *decoded);
    bool done = false;
    try {
        done = decode_unguarded(decoded, header, bytes, length, name, error);
    } catch (const std::exception &exception) {
        decode_failed(name, header->file, exception.what(), error);
    } catch (...) {
        decode_failed(name, header->file, "", error);
    }
    if (!done) {
        std::free(decoded->texels);
        std::free(decoded->names);
        std::memset(decoded, 0, sizeof *decoded);
    }
    return done;
}

bool encode_failed(const char *name, lsf_image_file file, const std::string &cause,
                   lsf_error *error)
{
    return lsf_error_set(error, LSF_ERROR_FILE, "%s: cannot encode %s: %s", name, file_kinds[file],
                         cause.c_str());
}

bool encode_unguarded(const lsf_encode_request *request, void **bytes, size_t *length,
                      const char *name, lsf_error *error)
{
    OIIO::TypeDesc type = request->file == LSF_IMAGE_FILE_PNG ? OIIO::TypeUInt8 : OIIO::TypeFloat;
    OIIO::ImageSpec spec(static_cast<int>(request->width), static_cast<int>(request->height),
                         static_cast<int>(request->channels), type);
    if (request->file == LSF_IMAGE_FILE_EXR) {
        spec.channelnames.clear();
        for (uint32_t c = 0; c < request->channels; c++)
            spec.channelnames.emplace_back(request->names[c]);
        spec.attribute("compression", "zip");
    }
    /* Without this, colours are taken to be multiplied by alpha, and divided. */
    spec.attribute("oiio:UnassociatedAlpha", 1);
    /* Half the time of the default 6 for files 4 % larger. */
    spec.attribute("png:compressionLevel", 4);
    /* Otherwise EXR gets the time of day, and equal pictures would make unequal files. */
    spec.attribute("DateTime", "");
    spec.attribute("oiio:ColorSpace", request->file == LSF_IMAGE_FILE_PNG ? "sRGB" : "Linear");

    for (uint32_t i = 0; i < request->text_count; i++)
        spec.attribute(request->texts[i].key, request->texts[i].value);

    auto output = OIIO::ImageOutput::create(plugin_names[request->file]);
    if (!output)
        return encode_failed(name, request->file, OIIO::geterror(), error);
    std::vector<unsigned char> buffer;
    OIIO::Filesystem::IOVecOutput writer(buffer);
    if (!output->set_ioproxy(&writer) || !output->open("memory", spec) ||
        !output->write_image(type, request->texels) || !output->close())
        return encode_failed(name, request->file, output->geterror(), error);

    *bytes = lsf_alloc(buffer.size(), 1);
    if (!*bytes)
        return encode_failed(name, request->file, "out of memory", error);
    std::memcpy(*bytes, buffer.data(), buffer.size());
    *length = buffer.size();
    return true;
}

bool encode(const lsf_encode_request *request, void **bytes, size_t *length, const char *name,
            lsf_error *error)
{
    try {
        return encode_unguarded(request, bytes, length, name, error);
    } catch (const std::exception &exception) {
        return encode_failed(name, request->file, exception.what(), error);
    } catch (...) {
        return encode_failed(name, request->file, "unknown exception", error);
    }
}

} // namespace

extern "C" __attribute__((visibility("default")))
const lsf_image_module lsf_openimageio = {decode, encode};
