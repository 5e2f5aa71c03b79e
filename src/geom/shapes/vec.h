#pragma once
// GLM's vectors under short names. f: single precision (as engines use), d: double (for the scene), i: whole numbers.

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace clusterbench {

using Vec3f = glm::vec3;
using Vec3d = glm::dvec3;
using Vec2d = glm::dvec2;
using Vec4d = glm::dvec4;
using Vec2i = glm::ivec2;
using Vec3i = glm::ivec3;
using Mat3d = glm::dmat3;
using Mat4d = glm::dmat4;

}  // namespace clusterbench
