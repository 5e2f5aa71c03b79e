#pragma once
// The function with which a shader finds the cell of a sample, for the constants of report/sizing/lookup_constants.h.

#include <string>
#include <vector>

#include "report/sizing/lookup_constants.h"
#include "result/case.h"

namespace clusterbench::report {

// `int NAME_cell_of(...)` in the language, which reads constants that begin with the same name; "" where the grid's
// facts do not say enough. It takes, and says so in a comment:
//   frustum, distance: the pixel from the top left and the depth, or the distance from the eye, in metres
//   cascades: the sample in view space
//   world: the sample in the world, relative to the grid's origin
// and gives -1 outside of the grid. The first two have another form with the viewport as a last argument, and
// `ivec2 NAME_tiles_of(vec2 viewport)`, but for cubical cells, whose slices depend on the viewport. As the tool's own
// lookup, but for the logarithm, which is the shader's.
std::string lookup_function_hlsl(const std::string& name, const result::Case& result_case);
std::string lookup_function_glsl(const std::string& name, const result::Case& result_case);

}  // namespace clusterbench::report
