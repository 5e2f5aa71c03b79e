#pragma once
// A glTF scene as this tool uses it: lights, cameras, the node tree that moves them, animations. Images and materials
// are never read, triangles only by load_geometry() (geometry.h). Transforms stay in double precision.

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geom/shapes/vec.h"

namespace clusterbench::scene {

enum class LightType : std::uint8_t { point, spot, directional, box };
enum class RangeSource : std::uint8_t { given, from_intensity, clamped_to_max };

// One light instance: a node that refers to a KHR_lights_punctual definition, or an oriented box that is assigned like
// a light (assign_boxes). The node's transform does not scale range and intensity (by definition of the extension), but
// it scales a box.
struct Light {
  std::string name;  // node name, else light name, else "light N"
  LightType type = LightType::point;
  int node = -1;
  Vec3d color{1.0, 1.0, 1.0};
  double intensity = 1.0;               // candela (point, spot) or lux (directional)
  std::optional<double> range_given_m;  // from the file
  double range_m = 0.0;                 // after resolve_ranges(); >= 0, may be +inf
  RangeSource range_source = RangeSource::given;
  int definition = -1;  // index among the file's light definitions, which light channels move
  double inner_cone_rad = 0.0, outer_cone_rad = 0.78539816339744831;  // half-angles, spots only
  Vec3d half_extents_m{0.0};                                          // boxes only, in the node's own space
};

// An oriented box (decal, probe) from a node's extras, which glTF leaves to applications:
//   "extras": {"clusterbench_box": {"half_extents": [x, y, z]}}
// in metres of the node's own space. Its volume is the box after the node's transform, scale and shear included.
// Counted; assigned if assign_boxes() made a light of it.
struct OrientedBox {
  std::string name;
  int node = -1;
  Vec3d half_extents_m{0.5, 0.5, 0.5};
};

// The sides of an off-centre or jittered picture, as slopes: left < right, bottom < top.
struct ProjectionSides {
  double left, right, bottom, top;

  friend bool operator==(const ProjectionSides&, const ProjectionSides&) = default;
};

// How a camera's rectangle is put into a viewport of another shape; pixels stay square.
//   contain   the view is enlarged until it holds the whole rectangle, as glTF requires: nothing is cropped
//   vertical  the height is the camera's, the width follows from the viewport: a wider camera is cropped at its sides
// They differ only for a camera that is wider than the viewport.
enum class CameraFit : std::uint8_t { contain, vertical };

// A camera's projection as in glTF.
struct CameraProjection {
  bool orthographic = false;
  double yfov_rad = 0.0;               // perspective
  std::optional<double> aspect_ratio;  // perspective, width over height; without: the viewport's
  CameraFit fit = CameraFit::contain;
  // Perspective, in place of yfov and aspect ratio. glTF has no such camera; this tool reads it from the camera's
  //   "extras": {"clusterbench_sides": [left, right, bottom, top]}
  std::optional<ProjectionSides> sides;
  double xmag_m = 0.0, ymag_m = 0.0;  // orthographic: half extents
  double near_m = 0.1, far_m = 0.0;   // far may be +inf (perspective without zfar)
};

struct Camera {
  std::string name;  // node name, else camera name, else "camera N"
  int node = -1;
  CameraProjection projection;
  bool animated = false;  // its projection, its node or one above it has an animation channel
  int definition = -1;    // index among the file's cameras, which projection channels move
};

struct Node {
  std::string name;
  int parent = -1;  // always smaller than the node's own index: parents come first
  int gltf_index = -1;
  std::shared_ptr<const Mat4d> matrix{};  // in place of the three below; few nodes have one
  Vec3d translation{0.0};
  Vec4d rotation{0.0, 0.0, 0.0, 1.0};  // quaternion x, y, z, w
  Vec3d scale{1.0};
  bool visible = true;  // KHR_node_visibility: an invisible node hides the lights on it and below it
};

enum class Interpolation : std::uint8_t { linear, step, cubic_spline };
// The first four belong to nodes, the next five to light definitions, the others to camera definitions. Angles in
// radians.
enum class ChannelPath : std::uint8_t {
  translation,
  rotation,
  scale,
  visible,
  range,
  intensity,
  color,
  inner_cone,
  outer_cone,
  yfov,
  aspect_ratio,
  near,
  far,
  xmag,
  ymag
};

struct Channel {
  int node = -1;        // a channel of a node, or
  int definition = -1;  // of all lights, or all cameras, of one definition
  ChannelPath path = ChannelPath::translation;
  Interpolation interpolation = Interpolation::linear;
  std::vector<double> times_s;  // ascending; equal ones only if neither light nor camera moves: the later one counts
  std::vector<Vec4d> values;    // one per key; cubic spline: in-tangent, value, out-tangent per key
};

// The range of a light without `range`: the distance at which its brightest colour channel falls to cutoff_lux,
// sqrt(intensity * max(color) / cutoff_lux), at most max_range_m. Given ranges stay.
struct RangeRule {
  double cutoff_lux = 0.05;
  double max_range_m = 100.0;
};

// The scenes and animations to read from a file: a name, or a number from 0. Empty: the file's default scene, and all
// animations, played together.
struct GltfChoice {
  std::string scene, animation;

  friend bool operator==(const GltfChoice&, const GltfChoice&) = default;
};

// Facts about a file besides the scene that is read.
struct GltfContents {
  std::string generator;                        // asset/generator: usually the exporter
  std::vector<std::string> scenes, animations;  // their names, "" without
  std::size_t scene = 0;                        // the scene that is read, if there are any
  std::size_t unread_lights = 0;                // of other scenes and of unsupported extensions
};

// "0 'idle', 1 'walk'": names with their numbers.
std::string numbered(const std::vector<std::string>& names);

struct Scene {
  std::string name;  // file stem
  std::filesystem::path path;
  std::string sha256;         // of the file's bytes (external buffers' follow in order)
  std::vector<Node> nodes;    // reachable from the default scene; parents first
  std::vector<Light> lights;  // in node order; without those that are never visible
  std::vector<Camera> cameras;
  std::vector<OrientedBox> boxes;
  std::vector<Channel> channels;         // that move nodes; of all animations, played together
  std::vector<Channel> light_channels;   // that change lights; ascending by definition
  std::vector<Channel> camera_channels;  // that change cameras' projections; ascending by definition
  double duration_s = 0.0;               // last key of any channel
  RangeRule range_rule;                  // the rule that resolved ranges; also applied to animated intensities
  std::vector<std::string> warnings;
  GltfContents contents;  // of its file; empty for scenes without a file
};

// Reads glTF, with any file extension. Throws Error (file, JSON pointer) for errors in the parts that this tool reads,
// and for other programs' files, with advice for converting them to glTF.
Scene load_gltf(const std::filesystem::path& path, const GltfChoice& choice = {});

// Why a scene has nothing to assign, and how its exporter writes lights; "" if it has lights or boxes.
std::string why_no_lights(const Scene& scene);

// Appends the scene's boxes to its lights, so that they are assigned. They light nothing: their intensity is 0.
void assign_boxes(Scene& scene);

void resolve_ranges(Scene& scene, const RangeRule& rule);
void resolve_range(Light& light, const RangeRule& rule);

// World transforms of all nodes at a time (animations clamp to their first and last key).
std::vector<Mat4d> world_transforms(const Scene& scene, double time_s);
// Without animations.
std::vector<Mat4d> rest_transforms(const Scene& scene);
// The nodes that are drawn at a time (KHR_node_visibility, inherited down the tree).
std::vector<bool> visible_nodes(const Scene& scene, double time_s);

// The shortest turn (a quaternion) from -z, the direction of spots and cameras, to a direction.
Vec4d rotation_towards(const Vec3d& direction);

// A point light, a spot light or a box in world space at one time: the input of the truth.
struct WorldLight {
  int rig_index = -1;  // index in Scene::lights
  LightType type = LightType::point;
  Vec3d position{0.0};
  double range_m = 0.0;                // for a box: distance from its middle to its farthest corner, rounded up
  Vec3d direction{0.0, 0.0, -1.0};     // unit up to rounding; spots
  double outer_cone_rad = 0.0;         // spots; in [0, pi/2]
  double inner_cone_rad = 0.0;         // spots: where their light begins to fall off; does not change the volume
  double luminous_intensity_cd = 1.0;  // the intensity times the colour's luminance (Rec. 709); boxes: 0
  // Boxes: from the middle to the middles of three faces, so that the volume is all position + a * half_axes_m[0] + b *
  // half_axes_m[1] + c * half_axes_m[2] with a, b and c from -1 to 1. Under a sheared node they are not orthogonal; a
  // decal may have a thickness of 0.
  std::array<Vec3d, 3> half_axes_m{};
};

// The distance from the middle of a box with these half axes to its farthest corner, rounded up.
double corner_distance_m(const std::array<Vec3d, 3>& half_axes_m);

// All point lights, then all spot lights, then all boxes, each in Scene::lights order. Directional lights touch
// everything and are left out. A light that is invisible at that time has a range of 0, so that it lights nothing and
// the others keep their indices.
std::vector<WorldLight> world_lights(const Scene& scene, double time_s);

// A camera's pose: view = view_from_world * (world - eye). Rows are unit and orthogonal up to rounding: the node's
// scale and shear are removed.
struct CameraPose {
  Vec3d eye{0.0};
  Mat3d view_from_world{1.0};
};
CameraPose camera_pose(const Scene& scene, const Camera& camera, double time_s);
CameraPose camera_pose(const Mat4d& world);  // of the camera's node

// A camera's projection at a time. Throws Error if it shows nothing then (no angle, no size, zfar not beyond znear):
// its channels are animated separately.
CameraProjection projection_at(const Scene& scene, const Camera& camera, double time_s);

}  // namespace clusterbench::scene
