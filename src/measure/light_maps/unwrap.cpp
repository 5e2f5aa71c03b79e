#include "measure/light_maps/unwrap.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>

#include "core/error.h"
#include "core/memory.h"

namespace clusterbench::measure {
namespace {

using Corner = std::tuple<double, double, double>;
using Side = std::pair<Corner, Corner>;  // ends in ascending order

Corner corner_of(const Vec3d& at) {
  return {at.x, at.y, at.z};
}
Side side_of(const MapTriangle& triangle, std::size_t i) {
  const Corner a = corner_of(triangle.corners[i]), b = corner_of(triangle.corners[(i + 1) % 3]);
  return a < b ? Side{a, b} : Side{b, a};
}

// Of length 0 for a triangle without area.
Vec3d normal_of(const MapTriangle& triangle) {
  const Vec3d normal = glm::cross(triangle.corners[1] - triangle.corners[0], triangle.corners[2] - triangle.corners[0]);
  const double size = glm::length(normal);
  return size > 0.0 ? normal / size : Vec3d(0.0);
}

struct Face {
  std::vector<std::uint32_t> triangles;
  Vec3d along{1.0, 0.0, 0.0}, up{0.0, 1.0, 0.0};  // unit vectors in the plane of the face
  Vec2d least{0.0};                               // smallest coordinates of its corners, in texels along these vectors
  std::int64_t width = 0, height = 0;             // texels, with the border of one texel
  std::int64_t x = 0, y = 0;                      // position in the map
};

class Unwrapper {
 public:
  Unwrapper(const MapMesh& mesh, double texels_per_metre) : mesh_(mesh), scale_(texels_per_metre) {
    // One node of the edge tree, and the memory of faces.
    check_memory("edges of triangles", 3 * mesh.triangles.size(), 160, scene::k_fewer_triangles);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      normals_.push_back(normal_of(mesh.triangles[t]));
      for (std::size_t i = 0; i < 3; ++i) at_side_[side_of(mesh.triangles[t], i)].push_back(t);
    }
  }

  Unwrapped make() {
    find_faces();
    for (Face& face : faces_) lay_down(face);
    const TexelGrid grid = pack();
    Unwrapped out{grid, std::vector<UvTriangle>(mesh_.triangles.size())};
    for (const Face& face : faces_)
      for (const std::uint32_t t : face.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
          const Vec2d at = flat(face, mesh_.triangles[t].corners[i]) - face.least;
          out.uvs[t][i] = {static_cast<float>((at.x + static_cast<double>(face.x) + 1.0) / grid.width),
                           static_cast<float>((at.y + static_cast<double>(face.y) + 1.0) / grid.height)};
        }
    return out;
  }

 private:
  static constexpr std::uint32_t k_none = ~0U;

  void find_faces() {
    constexpr double k_flat = 0.9999;  // cosine of 0.8 degrees
    face_of_.assign(mesh_.triangles.size(), k_none);
    for (std::uint32_t first = 0; first < face_of_.size(); ++first) {
      if (face_of_[first] != k_none) continue;
      const auto number = static_cast<std::uint32_t>(faces_.size());
      Face face;
      face.triangles = {first};
      face_of_[first] = number;
      for (std::size_t next = 0; next < face.triangles.size(); ++next)
        for (std::size_t i = 0; i < 3; ++i)
          for (const std::uint32_t other : at_side_[side_of(mesh_.triangles[face.triangles[next]], i)]) {
            if (face_of_[other] != k_none || glm::dot(normals_[first], normals_[other]) < k_flat) continue;
            face_of_[other] = number;
            face.triangles.push_back(other);
          }
      faces_.push_back(std::move(face));
    }
  }

  // No other triangle of the face shares this edge.
  bool is_outer(const Side& side, std::uint32_t face) const {
    const std::vector<std::uint32_t>& there = at_side_.at(side);
    return std::ranges::count_if(there, [&](std::uint32_t t) { return face_of_[t] == face; }) == 1;
  }

  Vec2d flat(const Face& face, const Vec3d& at) const {
    const Vec3d from = at - mesh_.triangles[face.triangles.front()].corners[0];
    return {glm::dot(from, face.along) * scale_, glm::dot(from, face.up) * scale_};
  }

  void lay_down(Face& face) {
    double longest = 0.0;
    for (const std::uint32_t t : face.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d way = mesh_.triangles[t].corners[(i + 1) % 3] - mesh_.triangles[t].corners[i];
        const double size = glm::length(way);
        if (size <= longest || !is_outer(side_of(mesh_.triangles[t], i), face_of_[t])) continue;
        longest = size;
        face.along = way / size;
      }
    const Vec3d up = glm::cross(normals_[face.triangles.front()], face.along);
    if (glm::dot(up, up) > 0.0) face.up = glm::normalize(up);
    Vec2d most(-std::numeric_limits<double>::infinity());
    face.least = -most;
    for (const std::uint32_t t : face.triangles)
      for (const Vec3d& corner : mesh_.triangles[t].corners) {
        const Vec2d at = flat(face, corner);
        face.least = glm::min(face.least, at);
        most = glm::max(most, at);
      }
    const Vec2d size = most - face.least;
    refuse_above(std::max(size.x, size.y));
    face.width = static_cast<std::int64_t>(std::ceil(size.x)) + 2;
    face.height = static_cast<std::int64_t>(std::ceil(size.y)) + 2;
  }

  // Packs faces in rows, the highest first.
  TexelGrid pack() {
    std::int64_t texels = 0, widest = 1;
    std::vector<Face*> order;
    for (Face& face : faces_) {
      texels += face.width * face.height;
      widest = std::max(widest, face.width);
      order.push_back(&face);
    }
    std::ranges::stable_sort(order, [](const Face* a, const Face* b) { return a->height > b->height; });
    const std::int64_t wanted = static_cast<std::int64_t>(std::ceil(std::sqrt(static_cast<double>(texels))));
    const std::int64_t width = std::max(widest, wanted);
    std::int64_t x = 0, y = 0, row = 0;
    for (Face* face : order) {
      if (x + face->width > width) {
        y += row;
        x = row = 0;
      }
      face->x = x;
      face->y = y;
      x += face->width;
      row = std::max(row, face->height);
    }
    refuse_above(static_cast<double>(std::max(width, y + row)));
    return {static_cast<int>(width), static_cast<int>(std::max<std::int64_t>(1, y + row))};
  }

  void refuse_above(double texels) const {
    if (texels <= k_longest_map_side) return;
    throw Error("", "--texels-per-metre",
                "its map would be more than " + std::to_string(k_longest_map_side) +
                    " texels wide or high: use fewer texels per metre");
  }

  const MapMesh& mesh_;
  double scale_;
  std::vector<Vec3d> normals_;
  std::map<Side, std::vector<std::uint32_t>> at_side_;
  std::vector<std::uint32_t> face_of_;
  std::vector<Face> faces_;
};

}  // namespace

Unwrapped unwrapped(const MapMesh& mesh, double texels_per_metre) {
  return Unwrapper(mesh, texels_per_metre).make();
}

}  // namespace clusterbench::measure
