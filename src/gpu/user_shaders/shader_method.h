#pragma once
// A user's shaders as a method: the registry knows it like those that are built in.

#include <memory>

#include "assign/contract/assigner.h"
#include "gpu/user_shaders/shader_file.h"

namespace clusterbench::gpu {

assign::AssignerDescriptor descriptor_of(const std::shared_ptr<const ShaderFile>& file);

// Reads the file and adds its method to the registry, unless the same file was added before; then its descriptor as it
// was. Throws Error (file, JSON pointer), also where another method has the name.
const assign::AssignerDescriptor& add_shader_method(const std::filesystem::path& path);
// Throws Error (file, "/name") where a method that is no shader of a user's has the name.
void check_shader_name(const ShaderFile& file);
// Takes all of them out of the registry again; for tests. No configuration may be in use.
void remove_shader_methods();

}  // namespace clusterbench::gpu
