// Image files through OpenImageIO.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <new>
#include <string_view>

#include "core/image/image_file.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

[[noreturn]] void fail_read(const std::string& path, const std::string& reason) {
  throw Error("cannot read image " + path + ": " + reason);
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Libraries for JPEG fill what is missing with grey and only warn. Inside the scan no marker can
// occur, so that a complete file has its last end marker after its last start of scan.
void check_jpeg_complete(const std::string& path, std::string_view bytes) {
  const size_t scan = bytes.rfind("\xFF\xDA"), end = bytes.rfind("\xFF\xD9");
  if (end == std::string::npos || scan == std::string::npos || end < scan)
    fail_read(path, "the file is truncated");
}

// `memory`: where the bytes are; null: in the file.
std::unique_ptr<OIIO::ImageInput> open_image(const std::string& path, const std::string& file,
                                             OIIO::Filesystem::IOProxy* memory) {
  OIIO::ImageSpec configuration;
  // Colours as stored, not multiplied by alpha.
  configuration["oiio:UnassociatedAlpha"] = 1;
  // Readers that are given a configuration look for the proxy there.
  if (memory) configuration.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &memory);
  auto input = OIIO::ImageInput::open(file, &configuration, memory);
  if (!input) fail_read(path, OIIO::geterror());
  return input;
}

// What a broken header may claim before memory is asked for [channel values].
constexpr double most_values = 1e10;

void check_size(const std::string& path, const OIIO::ImageSpec& spec) {
  if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0)
    fail_read(path, "it has no pixels");
  if (spec.depth > 1) fail_read(path, "volumes are not images");
  if (double(spec.width) * spec.height * spec.nchannels > most_values)
    fail_read(path, "it is too large");
}

bool is_integer(OIIO::TypeDesc::BASETYPE type) {
  return type != OIIO::TypeDesc::FLOAT && type != OIIO::TypeDesc::HALF &&
         type != OIIO::TypeDesc::DOUBLE;
}

bool read(const std::string& path, OIIO::ImageInput& opened, ImageFile& out) {
  OIIO::ImageInput* const input = &opened;
  const OIIO::ImageSpec spec = input->spec();
  check_size(path, spec);
  out.width = spec.width;
  out.height = spec.height;
  out.channels = spec.nchannels;
  out.channel_names = spec.channelnames;
  out.integer = is_integer(static_cast<OIIO::TypeDesc::BASETYPE>(spec.format.basetype));
  const size_t count = spec.image_pixels() * static_cast<size_t>(spec.nchannels);
  for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
    if (attribute.type() == OIIO::TypeString) {
      out.metadata.emplace_back(attribute.name().string(), attribute.get_string());
    }
  }
  bool done = false;
  if (spec.format == OIIO::TypeUInt8) {
    out.bytes.resize(count);
    done = input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeUInt8, out.bytes.data());
  } else {
    out.floats.resize(count);
    done = input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, out.floats.data());
  }
  if (!done || input->has_error()) fail_read(path, input->geterror());
  return std::string_view(input->format_name()) == "jpeg";
}

void read_file(const std::string& path, ImageFile& out) {
  const auto input = open_image(path, path, nullptr);
  if (read(path, *input, out)) check_jpeg_complete(path, bytes_of(path));
}

void read_bytes(const EmbeddedFile& file, ImageFile& out) {
  OIIO::Filesystem::IOMemReader memory(file.bytes.data(), file.bytes.size());
  const auto input = open_image(file.name, "embedded." + file.ending, &memory);
  const bool jpeg = read(file.name, *input, out);
  input->close();
  const std::string_view text(reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size());
  if (jpeg) check_jpeg_complete(file.name, text);
}

// Writes one image of a type that `data` holds. Throws Failure.
void write(const std::string& path, const std::string& format, const OIIO::ImageSpec& spec,
           const void* data) {
  const auto fail = [&](const std::string& reason) {
    throw Failure("cannot write " + path + ": " + reason);
  };
  const auto output = OIIO::ImageOutput::create(format);
  if (!output) fail(OIIO::geterror());
  if (!output->open(path, spec)) fail(output->geterror());
  if (!output->write_image(spec.format, data)) fail(output->geterror());
  // What is still in buffers may meet a full disk.
  if (!output->close()) fail(output->geterror());
}

// Portable float map: "PF" or "Pf", lowest row first, a negative scale for little-endian floats.
void write_pfm(const std::string& path, const Image& image) {
  std::ofstream file(path, std::ios::binary);
  const bool grey = image.channels < 3;
  file << (grey ? "Pf" : "PF") << '\n' << image.width << ' ' << image.height << "\n-1.0\n";
  for (int y = image.height - 1; y >= 0; --y) {
    for (int x = 0; x < image.width; ++x) {
      file.write(reinterpret_cast<const char*>(image.pixel(x, y)), grey ? 4 : 12);
    }
  }
  file.close();
  if (!file) throw Failure("cannot write " + path + ": " + std::strerror(errno));
}

// The first three channels, for formats that hold no more.
Image first_three(const Image& image) {
  Image result(image.width, image.height, 3);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (int c = 0; c < 3; ++c)
        result.pixel(x, y)[c] = image.pixel(x, y)[std::min(c, image.channels - 1)];
    }
  }
  return result;
}

void write_exr(const std::string& path, const Image& image, const ImageMetadata& metadata) {
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeFloat);
  if (!image.channel_names.empty()) spec.channelnames = image.channel_names;
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  // Linear Rec.709 with D65 white: red, green, blue, white as x, y.
  const float primaries[8] = {0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f};
  spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), primaries);
  for (const auto& [key, value] : metadata) spec.attribute(key, value);
  write(path, "exr", spec, image.data.data());
}

}  // namespace
}  // namespace pssmlt

PSSMLT_EXPORT void pssmlt_read_image_bytes(const pssmlt::EmbeddedFile& file,
                                           pssmlt::ImageFile& out) {
  try {
    pssmlt::read_bytes(file, out);
  } catch (const std::bad_alloc&) {
    pssmlt::fail_read(file.name, "it is too large for the memory");
  }
}

PSSMLT_EXPORT void pssmlt_read_image(const std::string& path, pssmlt::ImageFile& out) {
  try {
    pssmlt::read_file(path, out);
  } catch (const std::bad_alloc&) {
    pssmlt::fail_read(path, "it is too large for the memory");
  }
}

PSSMLT_EXPORT void pssmlt_write_image(const std::string& path, const std::string& format,
                                      const pssmlt::Image& image,
                                      const pssmlt::ImageMetadata& metadata) {
  if (format == "pfm") return pssmlt::write_pfm(path, image);
  if (format == "exr") return pssmlt::write_exr(path, image, metadata);
  const pssmlt::Image rgb = pssmlt::first_three(image);
  const OIIO::ImageSpec spec(rgb.width, rgb.height, 3, OIIO::TypeFloat);
  pssmlt::write(path, format, spec, rgb.data.data());
}

PSSMLT_EXPORT void pssmlt_write_bytes(const std::string& path, const std::string& format,
                                      const pssmlt::ByteImage& image) {
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeUInt8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  if (format != "png") spec.attribute("Compression", "jpeg:98");
  pssmlt::write(path, format, spec, image.data.data());
}

static_assert(std::is_same_v<decltype(pssmlt_read_image), pssmlt::ReadFunction>);
static_assert(std::is_same_v<decltype(pssmlt_read_image_bytes), pssmlt::ReadBytesFunction>);
static_assert(std::is_same_v<decltype(pssmlt_write_image), pssmlt::WriteFunction>);
static_assert(std::is_same_v<decltype(pssmlt_write_bytes), pssmlt::WriteBytesFunction>);
