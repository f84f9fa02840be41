#include "io/gltf_import.hpp"

#include <cctype>
#include <cstdlib>
#include <cstring>

namespace lsf
{

bool uri_is_data(const std::string &uri)
{
    return uri.compare(0, 5, "data:") == 0;
}

/* "data:image/png;base64,iVBO": what an error message can show. */
static std::string excerpt(const std::string &uri)
{
    return uri.size() <= 120 ? uri : uri.substr(0, 117) + "...";
}

uint64_t uri_data_size(const std::string &uri, const std::string &location)
{
    size_t comma = uri.find(',');
    if (comma == std::string::npos || comma < 12 || uri.compare(comma - 7, 7, ";base64") != 0)
        fail("INVALID_URI", location,
             "\"%s\" is not a base64 data URI; use \"data:application/octet-stream;base64,...\" or "
             "a file",
             excerpt(uri.substr(0, comma)).c_str());
    size_t end = uri.size();
    for (int i = 0; i < 2 && end > comma + 1 && uri[end - 1] == '='; i++)
        end--;
    for (size_t i = comma + 1; i < end; i++)
        if (!std::isalnum((unsigned char)uri[i]) && uri[i] != '+' && uri[i] != '/')
            fail("INVALID_URI", location,
                 "byte %zu of the data URI is not base64; export the file again", i);
    uint64_t digits = end - comma - 1;
    if (digits % 4 == 1 || ((uri.size() - end) != 0 && (uri.size() - comma - 1) % 4 != 0))
        fail("INVALID_URI", location,
             "the data URI is cut: %llu base64 digits; export the file again",
             (unsigned long long)digits);
    return digits / 4 * 3 + (digits % 4 ? digits % 4 - 1 : 0);
}

std::string uri_data(const std::string &uri, const std::string &location)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    uint64_t size = uri_data_size(uri, location);
    std::string bytes;
    bytes.reserve(size);
    uint32_t bits = 0;
    for (size_t i = uri.find(',') + 1, digit = 0; bytes.size() < size; i++, digit++) {
        bits = bits << 6 | (uint32_t)(strchr(digits, uri[i]) - digits);
        if (digit % 4 != 0)
            bytes += (char)(bits >> (6 - digit % 4 * 2));
    }
    return bytes;
}

static int hex_digit(char c)
{
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

/* Spaces and other characters that RFC 3986 wants escaped are taken as they are. */
static std::string percent_decode(const std::string &uri, const std::string &location)
{
    std::string path;
    for (size_t i = 0; i < uri.size(); i++) {
        char c = uri[i];
        if (c == '%') {
            int high = i + 2 < uri.size() ? hex_digit(uri[i + 1]) : -1;
            int low = i + 2 < uri.size() ? hex_digit(uri[i + 2]) : -1;
            if (high < 0 || low < 0)
                fail("INVALID_URI", location,
                     "\"%s\": '%%' must be followed by two hexadecimal digits",
                     excerpt(uri).c_str());
            c = (char)(high * 16 + low);
            i += 2;
        }
        if (c == '\0')
            fail("INVALID_URI", location, "\"%s\" holds a NUL character", excerpt(uri).c_str());
        path += c;
    }
    return path;
}

/* RFC 3986: scheme = ALPHA *( ALPHA / DIGIT / "+" / "-" / "." ) */
static bool has_scheme(const std::string &uri)
{
    size_t colon = uri.find(':');
    if (colon == std::string::npos || colon == 0 || !std::isalpha((unsigned char)uri[0]))
        return false;
    for (size_t i = 0; i < colon; i++)
        if (!std::isalnum((unsigned char)uri[i]) && !strchr("+-.", uri[i]))
            return false;
    return true;
}

std::string uri_to_path(const std::string &folder, const std::string &uri,
                        const std::string &location)
{
    if (uri_is_data(uri))
        fail("INVALID_URI", location,
             "\"%s\": this data URI is not supported here; use base64 PNG or JPEG, or a file",
             excerpt(uri).c_str());
    if (folder.empty())
        fail("IO_ERROR", location,
             "\"%s\": a scene that is not read from a file cannot refer to files; embed them (as "
             ".glb, "
             "or as data URIs), or give the path of the file",
             excerpt(uri).c_str());
    if (has_scheme(uri))
        fail("INVALID_URI", location,
             "\"%s\": only files beside the scene are read; use a path relative to the file's "
             "folder",
             excerpt(uri).c_str());
    std::string relative = percent_decode(uri, location);
    lsf_error error;
    std::unique_ptr<char, decltype(&std::free)> path(
        lsf_path_confine(folder.c_str(), relative.c_str(), &error), std::free);
    if (!path)
        fail("IO_ERROR", location, "%s", error.message);
    return path.get();
}

bool uri_file_is_absent(const std::string &folder, const std::string &uri,
                        const std::string &location)
{
    if (uri.empty() || uri_is_data(uri) || folder.empty() || has_scheme(uri))
        return false;
    return lsf_path_is_absent(folder.c_str(), percent_decode(uri, location).c_str());
}

file_content file_read(const std::string &path, const memory_budget &budget)
{
    lsf_error error;
    file_content file;
    file.bytes.reset(lsf_file_read(path.c_str(), budget.left(), &file.length, &error));
    if (!file.bytes)
        throw failure(error.message);
    return file;
}

} // namespace lsf
