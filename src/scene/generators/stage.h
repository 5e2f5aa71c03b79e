#pragma once
// The base of all generators: lights and cameras are added to a stage, which writes them as binary glTF. All numbers
// are rounded to a few decimals, so that differences between math libraries do not change the file.

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/random.h"
#include "geom/shapes/vec.h"

namespace clusterbench::scene {

struct PathKey {
  double time_s;
  Vec3d position;
  double yaw_rad;  // 0 looks along -z, positive turns left
};

class Stage {
 public:
  explicit Stage(std::uint64_t seed);

  // Draw one number per call, or store each in a variable: compilers choose the evaluation order of a call's arguments.
  SplitMix64& random() { return random_; }
  Vec3d position_in(const Vec3d& lo, const Vec3d& hi);
  int light_count() const { return light_count_; }

  // Lights are children of `parent` (-1: the scene). range_m = 0: the file gives none.
  void point(const std::string& name, const Vec3d& position, double range_m, int parent = -1);
  void spot(const std::string& name, const Vec3d& position, const Vec3d& direction, double range_m,
            double half_angle_deg, int parent = -1);
  // An oriented box (decal, probe), turned by a quaternion.
  void box(const std::string& name, const Vec3d& position, const Vec4d& rotation, const Vec3d& half_extents_m,
           int parent = -1);
  // A node that moves along the keys; returns its number for use as a parent.
  int mover(const std::string& name, const std::vector<PathKey>& keys);
  // Static surfaces, three corners each, counterclockwise from outside.
  void mesh(const std::string& name, const std::vector<Vec3d>& corners);
  // The scene's camera: vertical field of view 60°, near 0.1 m.
  void camera(const std::string& name, const std::vector<PathKey>& keys, double far_m);

  std::string glb(const std::string& generator) const;

 private:
  int add_node(nlohmann::ordered_json node, int parent);
  int light_definition(const nlohmann::ordered_json& light);
  nlohmann::ordered_json definition(const char* type, double range_m);
  int float_accessor(const std::vector<float>& values, const char* type, std::size_t components, bool with_bounds);
  void animate(int node, const std::vector<PathKey>& keys);

  SplitMix64 random_;
  nlohmann::ordered_json document_;
  std::map<std::string, int> definitions_;
  std::string buffer_;
  int light_count_ = 0;
};

// Corners of two triangles: the parallelogram from one corner along two sides; its front faces along `along` x `up`.
void add_quad(std::vector<Vec3d>& corners, const Vec3d& from, const Vec3d& along, const Vec3d& up);
// The six sides of a box, from outside.
void add_box(std::vector<Vec3d>& corners, const Vec3d& lo, const Vec3d& hi);

// Keys along a closed or open polyline, looking along the way, at constant speed.
std::vector<PathKey> walk(const std::vector<Vec3d>& corners, double seconds);

}  // namespace clusterbench::scene
