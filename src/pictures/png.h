#pragma once
// A canvas as the bytes of a PNG file.

#include <string>

#include "pictures/canvas.h"

namespace clusterbench::pictures {

std::string png_of(const Canvas& canvas);

}  // namespace clusterbench::pictures
