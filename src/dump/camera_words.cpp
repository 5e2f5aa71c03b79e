#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/text.h"
#include "dump/camera.h"

namespace clusterbench::dump {
namespace {

std::vector<double> transposed(const std::vector<double>& m) {
  std::vector<double> out(m.size());
  for (std::size_t i = 0; i < m.size(); ++i) out[i] = m[i % 4 * 4 + i / 4];
  return out;
}

std::optional<Camera> camera_if_any(const result::DumpCamera& camera, bool lights_in_view_space) {
  try {
    return bare_camera_of(camera, lights_in_view_space);
  } catch (const Error&) {
    return std::nullopt;
  }
}

// Engines' matrices divide by z or -z itself. Transposed ones divide by the near plane's number, and may so give a
// camera by accident.
bool divides_by_depth(const result::DumpCamera& camera) {
  if (!camera.projection) return true;
  const std::vector<double>& m = *camera.projection;
  const bool is_by_rows = camera.order.value_or("columns") == "rows";
  const double w = std::abs(m[is_by_rows ? 14 : 11]);  // row 3, column 2
  constexpr double k_of_singles = 1e-4;
  return std::abs(w - 1.0) < k_of_singles || w < 1e-9;
}

bool is_same(const Camera& a, const Camera& b) {
  const view::Projection &p = a.projection, &q = b.projection;
  const auto near_to = [](double x, double y) {
    return x == y || std::abs(x - y) <= 1e-9 * std::max(std::abs(x), std::abs(y));
  };
  return a.is_world_mirrored == b.is_world_mirrored && a.view_space.rotation == b.view_space.rotation &&
         a.view_space.origin == b.view_space.origin && p.orthographic == q.orthographic && near_to(p.left, q.left) &&
         near_to(p.right, q.right) && near_to(p.bottom, q.bottom) && near_to(p.top, q.top) &&
         near_to(p.near_m, q.near_m) && near_to(p.far_m, q.far_m);
}

// Sets a word unless it has that value. `standard`: what its absence means.
void set_word(std::optional<std::string>& word, const std::string& value, const char* standard, const char* key,
              CameraWords& out) {
  if (word.value_or(standard) == value) return;
  word = value;
  out.changes.push_back(std::string("camera.") + key + " '" + value + "'");
}

// Both matrices are read in this order but the one that is transposed alone.
enum class Alone : std::uint8_t { none, view, projection };

void transpose_alone(Alone alone, CameraWords& out) {
  result::DumpCamera& camera = out.camera;
  if (alone == Alone::projection) {
    camera.projection = transposed(*camera.projection);
    out.changes.emplace_back("camera.projection alone transposed");
  } else if (alone == Alone::view) {
    auto& view = camera.world_to_view ? camera.world_to_view : camera.view_to_world;
    view = transposed(*view);
    out.changes.emplace_back(camera.world_to_view ? "camera.world_to_view alone transposed"
                                                  : "camera.view_to_world alone transposed");
  }
  out.is_transposed |= alone != Alone::none;
}

// The given one first.
std::vector<std::string> values(const std::optional<std::string>& given, std::vector<std::string> allowed) {
  const std::string first = given.value_or(allowed.front());
  std::stable_partition(allowed.begin(), allowed.end(), [&](const std::string& value) { return value == first; });
  return allowed;
}

CameraWords words_with(const result::DumpCamera& given, const std::string& order, Alone alone) {
  CameraWords out{given, {}, false};
  set_word(out.camera.order, order, "columns", "order", out);
  out.is_transposed = !out.changes.empty();
  transpose_alone(alone, out);
  return out;
}

// In the order in which they are believed; of as many changes, those of `order` first.
std::vector<CameraWords> all_words(const result::DumpCamera& given) {
  std::vector<CameraWords> out;
  std::vector<Alone> alone{Alone::none};
  if (given.projection) alone.push_back(Alone::projection);
  if (given.world_to_view.has_value() != given.view_to_world.has_value()) alone.push_back(Alone::view);
  for (const Alone matrix : alone)
    for (const std::string& clip_y : values(given.clip_y, {"up", "down"}))
      for (const std::string& depth : values(given.depth, {"0..1", "-1..1", "1..0"}))
        for (const std::string& forward : values(given.forward, {"-z", "+z"}))
          for (const std::string& order : values(given.order, {"columns", "rows"})) {
            CameraWords words = words_with(given, order, matrix);
            set_word(words.camera.depth, depth, "0..1", "depth", words);
            set_word(words.camera.forward, forward, "-z", "forward", words);
            set_word(words.camera.clip_y, clip_y, "up", "clip_y", words);
            if (!words.changes.empty()) out.push_back(std::move(words));
          }
  std::ranges::stable_sort(out, {}, [](const CameraWords& words) { return words.changes.size(); });
  return out;
}

}  // namespace

std::vector<CameraWords> other_camera_words(const result::DumpCamera& camera, bool lights_in_view_space) {
  std::vector<CameraWords> out;
  std::vector<Camera> known;
  if (const auto given = camera_if_any(camera, lights_in_view_space)) known.push_back(*given);
  for (CameraWords& words : all_words(camera)) {
    if (!divides_by_depth(words.camera)) continue;
    const std::optional<Camera> other = camera_if_any(words.camera, lights_in_view_space);
    if (!other || std::ranges::any_of(known, [&](const Camera& one) { return is_same(one, *other); })) continue;
    known.push_back(*other);
    out.push_back(std::move(words));
  }
  return out;
}

Camera camera_of(const result::DumpCamera& camera, bool lights_in_view_space) {
  try {
    return bare_camera_of(camera, lights_in_view_space);
  } catch (const Error& error) {
    std::vector<CameraWords> others = other_camera_words(camera, lights_in_view_space);
    if (others.empty()) throw;
    // First those that need no near_m and far_m: with a given far plane nearly any near plane makes a camera.
    std::stable_partition(others.begin(), others.end(), [&](const CameraWords& words) {
      result::DumpCamera own = words.camera;
      if (own.projection) own.near_m.reset(), own.far_m.reset();
      return camera_if_any(own, lights_in_view_space).has_value();
    });
    const CameraWords& best = others.front();
    // A projection that is read the other way round has consequences that would lead astray: "divides by z".
    const bool is_of_view = error.where() != "/camera/projection";
    std::string problem = best.is_transposed && !is_of_view ? "has its numbers transposed" : error.message();
    problem = problem.substr(0, problem.find("; with camera.order"));  // other words may be wrong, too
    throw Error("", error.where(), problem + "; with " + joined(best.changes, " and ") + " it is a camera's",
                error.code());
  }
}

}  // namespace clusterbench::dump
