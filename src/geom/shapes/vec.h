#pragma once
// Vectors under short names. f: single precision (as engines use), d: double (for the scene), i: whole numbers. They
// are GLM's; where the library for engines is built without GLM, its own (CLUSTERBENCH_OWN_VECTORS), which round alike.

#if CLUSTERBENCH_OWN_VECTORS

#include "geom/shapes/own_vectors.h"

namespace clusterbench {

namespace glm = own_vectors;  // for the functions: glm::dot

using Vec3f = own_vectors::Vec<float, 3>;
using Vec3d = own_vectors::Vec<double, 3>;
using Vec2d = own_vectors::Vec<double, 2>;
using Vec4d = own_vectors::Vec<double, 4>;
using Vec2i = own_vectors::Vec<int, 2>;
using Vec3i = own_vectors::Vec<int, 3>;
using Mat3d = own_vectors::Mat<double, 3>;
using Mat4d = own_vectors::Mat<double, 4>;

}  // namespace clusterbench

#else

#include <glm/geometric.hpp>
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

#endif
