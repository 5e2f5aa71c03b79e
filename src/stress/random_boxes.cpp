#include "stress/random_boxes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "stress/contact.h"
#include "stress/random_setting.h"

namespace clusterbench::stress {
namespace {

// Its middle and half axes, in the grid's space.
struct DrawnBox {
  Vec3d middle{0.0};
  Mat3d half_axes{1.0};
};

class BoxDraw {
 public:
  BoxDraw(Trial& trial, double far_m, double step_m, Draw& draw)
      : trial_(trial),
        far_m_(far_m),
        step_m_(step_m),
        draw_(draw),
        frame_(frame_of(trial)),
        grid_(grid_of(trial, frame_)),
        space_(grid::space_of(grid_, frame_)) {}

  void add() {
    const int way = draw_.whole(0, 99);
    put(way < 45 ? touching() : way < 75 ? on_lattice() : anywhere());
  }

 private:
  // Against a cell's face, edge or corner; then, sometimes, larger or smaller by a little or by ulps.
  DrawnBox touching() {
    const Contact contact = random_contact(grid_.cell(random_cell(grid_, draw_.random())), draw_.random());
    const double distance = std::max(glm::length(contact.point), 1e-3 * step_m_);
    DrawnBox box{Vec3d(0.0), axes(distance * draw_.log_between(1e-4, 3.0))};
    double reach = 0.0;  // towards the cell
    for (int axis = 0; axis < 3; ++axis) reach += std::abs(glm::dot(box.half_axes[axis], contact.outward));
    box.middle = contact.point + reach * contact.outward;
    if (draw_.percent(40)) box.half_axes *= draw_.about_one(1e-16, 1e-3);
    if (draw_.percent(50))
      for (int axis = 0; axis < 3; ++axis) box.middle[axis] = draw_.nudged(box.middle[axis], 4);
    return box;
  }

  // Whole coordinates and sizes.
  DrawnBox on_lattice() {
    DrawnBox box;
    for (int axis = 0; axis < 3; ++axis) {
      box.middle[axis] = step_m_ * draw_.whole(-8, 8);
      box.half_axes[axis] *= step_m_ * draw_.whole(draw_.percent(20) ? 0 : 1, 6);
    }
    box.middle.z = -std::abs(box.middle.z);
    if (draw_.percent(25)) box.half_axes = Mat3d(0.6, 0.8, 0.0, -0.8, 0.6, 0.0, 0.0, 0.0, 1.0) * box.half_axes;
    return box;
  }

  DrawnBox anywhere() {
    const double depth = far_m_ * draw_.log_between(1e-5, 2.0);
    const Vec3d middle{depth * draw_.between(-1.5, 1.5), depth * draw_.between(-1.0, 1.0),
                       draw_.percent(85) ? -depth : depth};
    return {middle, axes(depth * draw_.log_between(1e-4, 10.0))};
  }

  // Of about a size: along the space's axes or turned; long, flat, sheared and mirrored ones.
  Mat3d axes(double size) {
    Mat3d out(1.0);
    if (draw_.percent(70)) {
      out[0] = direction();
      out[1] = glm::normalize(glm::cross(out[0], direction()) + Vec3d(1e-9, 0.0, 0.0));
      out[2] = glm::cross(out[0], out[1]);
    }
    if (draw_.percent(15)) out[1] += draw_.between(-1.0, 1.0) * out[0];
    for (int axis = 0; axis < 3; ++axis) out[axis] *= size * (draw_.percent(50) ? 1.0 : draw_.log_between(1e-3, 1.0));
    if (draw_.percent(15)) out[draw_.whole(0, 2)] *= draw_.percent(50) ? 0.0 : 1e-12;
    if (draw_.percent(10)) out[0] = -out[0];
    return out;
  }

  Vec3d direction() {
    const double along = draw_.between(-1.0, 1.0), turn = draw_.between(0.0, 6.28),
                 across = std::sqrt(1.0 - along * along);
    return {across * std::cos(turn), along, across * std::sin(turn)};
  }

  void put(const DrawnBox& box) {
    const Mat3d to_world = glm::transpose(space_.rotation);
    const Vec3d middle = to_world * box.middle + space_.origin;
    const Mat3d axes = to_world * box.half_axes;
    constexpr double k_largest_m = 1e14;  // corners, too, are within the limits of a scene
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(middle[axis]) <= k_largest_m) || !(glm::length(axes[axis]) <= k_largest_m)) return;
    scene::Light light;
    light.type = scene::LightType::box;
    light.name = "box " + std::to_string(trial_.scene.lights.size());
    light.node = static_cast<int>(trial_.scene.nodes.size());
    light.intensity = 0.0;
    light.half_extents_m = Vec3d(1.0);
    light.range_m = 1.0;
    scene::Node node;
    node.name = light.name;
    Mat4d matrix(1.0);
    for (int axis = 0; axis < 3; ++axis) matrix[axis] = Vec4d(axes[axis], 0.0);
    matrix[3] = Vec4d(middle, 1.0);
    node.matrix = std::make_shared<const Mat4d>(matrix);
    trial_.scene.nodes.push_back(node);
    trial_.scene.lights.push_back(light);
  }

  Trial& trial_;
  double far_m_, step_m_;
  Draw& draw_;
  view::Frame frame_;
  grid::Grid grid_;
  view::Space space_;
};

}  // namespace

void add_random_boxes(Trial& trial, double far_m, double step_m, std::uint64_t seed) {
  constexpr std::uint64_t k_other_source = 0x626f786573;
  Draw draw(seed ^ k_other_source);
  if (!draw.percent(10)) return;
  BoxDraw boxes(trial, far_m, step_m, draw);
  for (int i = draw.whole(1, 8); i > 0; --i) boxes.add();
}

}  // namespace clusterbench::stress
