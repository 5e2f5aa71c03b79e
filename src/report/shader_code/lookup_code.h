#pragma once
// The function with which a shader finds the cell of a sample, for the constants of
// report/shader_code/lookup_constants.h.

#include <string>
#include <vector>

#include "report/shader_code/lookup_constants.h"
#include "result/case.h"

namespace clusterbench::report {

// `int NAME_cell_of(...)` in the language, which reads constants with the same prefix; "" if the recorded facts on the
// grid are not sufficient. Its parameters, also described in a comment of the code:
//   frustum, distance: the pixel from the top left and the depth, or the distance from the eye, in metres
//   cascades: the sample in view space
//   world: the sample in the world, relative to the grid's origin
// Returns -1 outside of the grid. The first two have another form with the viewport as a last argument, and
// `ivec2 NAME_tiles_of(vec2 viewport)`, except for cubical cells, whose slices depend on the viewport. Equal to the
// tool's own lookup, except for the logarithm, which is the shader's.
std::string lookup_function_hlsl(const std::string& name, const result::Case& result_case);
std::string lookup_function_glsl(const std::string& name, const result::Case& result_case);

}  // namespace clusterbench::report
