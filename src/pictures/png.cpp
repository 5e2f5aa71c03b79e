#include "pictures/png.h"

#include <png.h>

#include "core/error.h"

namespace clusterbench::pictures {
namespace {

void write(png_image& image, void* to, png_alloc_size_t& bytes, const Canvas& canvas) {
  constexpr int k_eight_bits = 0, k_stride = 0;
  if (png_image_write_to_memory(&image, to, &bytes, k_eight_bits, canvas.pixels.data(), k_stride,
                                canvas.palette.data()) != 0)
    return;
  const std::string message = image.message;
  png_image_free(&image);
  throw Error("libpng", "", message, ExitCode::internal);
}

}  // namespace

std::string png_of(const Canvas& canvas) {
  static_assert(sizeof(Rgb) == 3);  // libpng's layout of a palette
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(canvas.size.x);
  image.height = static_cast<png_uint_32>(canvas.size.y);
  image.format = PNG_FORMAT_RGB_COLORMAP;
  image.colormap_entries = static_cast<png_uint_32>(canvas.palette.size());
  png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string out(bytes, '\0');
  write(image, out.data(), bytes, canvas);
  out.resize(bytes);
  return out;
}

}  // namespace clusterbench::pictures
