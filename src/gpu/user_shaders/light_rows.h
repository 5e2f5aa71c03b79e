#pragma once
// The lights of a frame as a shader has them.

#include "gpu/user_shaders/number_bytes.h"
#include "result/documents/shader.h"
#include "view/frame.h"

namespace clusterbench::gpu {

// Writes the lights, in the order of their indices, as `rows` say. View space: as the method's camera looks. Throws
// Error ("", `where`) for a number that its type does not have.
void write_lights(const result::ShaderMethod& method, const result::ShaderLightRows& rows,
                  const view::LightArrays& lights, ByteImage& out, const std::string& where);
// Bytes up to the end of the last light.
std::uint64_t bytes_of_lights(const result::ShaderLightRows& rows, std::uint64_t lights);
// Numbers that a field takes: 3 or 1.
std::size_t numbers_of(const result::ShaderLightField& field);

}  // namespace clusterbench::gpu
