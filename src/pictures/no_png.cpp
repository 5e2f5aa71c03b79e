// Of a build without libpng: `--images` is refused before anything is drawn.

#include "core/error.h"
#include "core/libraries.h"
#include "pictures/png.h"

namespace clusterbench::pictures {

std::string png_of(const Canvas& /*canvas*/) {
  throw Error("", "--images", missing_library(Library::libpng));
}

}  // namespace clusterbench::pictures
