#pragma once
// What can be found wrong in a description of shaders without a device and without a frame.

#include "gpu/user_shaders/shader_file.h"

namespace clusterbench::gpu {

// Of a record whose modules are read. Throws Error ("", JSON pointer).
void check_shader_method(const ShaderFile& file);

}  // namespace clusterbench::gpu
