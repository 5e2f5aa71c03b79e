#include "pictures/pictures.h"

#include <algorithm>
#include <cstdio>
#include <deque>
#include <optional>
#include <set>
#include <tuple>

#include "assign/contract/storage.h"
#include "core/error.h"
#include "core/libraries.h"
#include "pictures/file_names.h"
#include "pictures/png.h"
#include "run/cases/frame_lights.h"
#include "run/cases/path_culls.h"
#include "run/cases/path_frames.h"

namespace clusterbench::pictures {
namespace {

constexpr int k_strip_frames = 8, k_strip_longest_side = 240;

// A frame, shared by all cases of a group.
struct PicturedFrame {
  view::Frame frame;
  grid::Grid grid;
  run::FrameLights lights;
  std::shared_ptr<const depth::DepthImage> depth;  // if a method needs it
};

// A case's light structure in a frame.
class Answer {
 public:
  Answer(const config::Config& config, const run::CasePlan& plan, const PicturedFrame& now, const run::PathFrames& path)
      : culls_(config, plan, path), run_(config, plan.method(), culls_.of(plan.method())) {
    const view::LightArrays& lights = now.lights.in_precision(plan.precision);
    run_.build(now.grid, assign::kinds_of(lights));
    run_.assign(now.frame, lights, now.depth.get());
    if (plan.storage) {
      const config::MethodRequest& request = config.storages[*plan.storage];
      storage_ = assign::find_storage(request.name)->make(request.params);
      storage_->start(now.grid, now.frame.ranges());
      run_.store(*storage_);
    }
    mapped_ = run_.mapped(made());
  }

  const assign::LightStructure& structure() const {
    if (mapped_) return *mapped_;
    return made();
  }

 private:
  const assign::LightStructure& made() const { return storage_ ? *storage_ : *run_.own_structure(); }

  run::PathCulls culls_;
  run::CulledRun run_;
  std::unique_ptr<assign::Storage> storage_;       // none: the method's own structure
  std::optional<assign::MappedStructure> mapped_;  // behind a pre-cull
};

class Drawing {
 public:
  Drawing(const config::Config& config, const run::Plan& plan, const Geometries& geometries, const Request& request,
          const LongestLists& longest, const Listener& listener, const std::atomic<bool>& stop)
      : config_(config),
        plan_(plan),
        request_(request),
        longest_(longest),
        listener_(listener),
        stop_(stop),
        total_(picture_count(plan, request)) {
    for (std::size_t i = 0; i < plan.scenes.size(); ++i) {
      own_depths_.emplace_back();
      if (geometries[i] && !geometries[i]->empty()) own_depths_[i].emplace(plan.scenes[i].scene, *geometries[i]);
    }
  }

  void draw() {
    for (const run::GroupPlan& group : plan_.groups)
      if (!stop_) draw_group(group);
  }

 private:
  // The common data for pictures of one group.
  struct Group {
    const run::GroupPlan& plan;
    run::PathFrames path;
    std::vector<const run::CasePlan*> cases;  // that can be pictured
  };

  void draw_group(const run::GroupPlan& plan) {
    const run::SceneData& data = plan_.scenes[plan.scene];
    Group group{plan,
                {data.scene, data.paths[plan.camera], config_.viewports[plan.viewport], depths_of(plan.scene),
                 config_.threads, data.visible_sets.get()},
                {}};
    for (const run::CasePlan& case_plan : plan.cases)
      if (can_picture(group, case_plan)) group.cases.push_back(&case_plan);
    if (group.cases.empty()) return;
    for (const int frame : frames_of(group))
      if (!stop_) draw_frame(group, frame);
    if (request_.wants(Kind::strip) && !stop_) draw_strips(group);
  }

  // nullptr: of a scene without triangles.
  run::FrameDepths* depths_of(std::size_t scene) {
    if (plan_.scenes[scene].depths) return plan_.scenes[scene].depths.get();
    return own_depths_[scene] ? &*own_depths_[scene] : nullptr;
  }

  // Not a case in which a plug-in broke down. A structure that is cut to the depths of visible surfaces has no answer
  // for a plane.
  bool can_picture(const Group& group, const run::CasePlan& case_plan) const {
    const assign::AssignerDescriptor& method = run::method_of(config_, case_plan);
    if (!method.plugin.empty() && !longest_.contains(case_plan.id)) return false;
    if (!method.needs.depth || !is_on_plane(group)) return true;
    if (listener_.on_skipped)
      listener_.on_skipped(case_plan.name, "its lists are those of visible surfaces: no picture of a plane");
    return false;
  }

  bool is_on_plane(const Group& group) const { return request_.plane_m || group.path.depths() == nullptr; }

  std::vector<int> frames_of(const Group& group) const {
    if (request_.frames == Request::Frames::first) return {0};
    if (request_.frames == Request::Frames::worst) return {worst_frame(group)};
    std::vector<int> frames;
    for (const int frame : request_.listed)
      if (frame < group.path.count()) frames.push_back(frame);
    return frames;
  }

  int worst_frame(const Group& group) const {
    const LongestList* worst = nullptr;
    for (const run::CasePlan* case_plan : group.cases) {
      const auto found = longest_.find(case_plan->id);
      if (found != longest_.end() && (worst == nullptr || found->second.lights > worst->lights)) worst = &found->second;
    }
    return worst == nullptr ? 0 : worst->frame;
  }

  PicturedFrame prepare(const Group& group, int index) const {
    PicturedFrame now;
    now.frame = group.path.frame(index);
    run::GridOfFrames grids(config_.grids[group.plan.grid]);
    grids.update(group.path, now.frame);
    now.grid = grids.grid();
    now.lights = run::FrameLights(config_.precisions, view::lights_in(now.frame, grid::space_of(now.grid, now.frame)));
    now.depth = run::depths_for(config_, group.plan, group.path, now.frame);
    return now;
  }

  Surface surface_of(const Group& group, const view::Frame& frame, int divisor) const {
    const depth::PixelGrid pixels(frame.viewport, divisor);
    if (!is_on_plane(group))
      return visible_surface(frame, depth::thinned(*group.path.depths()->of(frame, config_.threads), pixels));
    const double far_m = run::sample_far(frame, group.path.far_m());
    return plane(frame, pixels, request_.plane_m.value_or(depth_amid_lights(frame, far_m)));
  }

  int divisor_of(const Group& group) const {
    return request_.divisor > 0 ? request_.divisor
                                : divisor_for(config_.viewports[group.plan.viewport], k_longest_side);
  }

  Heading heading(const Group& group, const std::string& frames, int divisor, const Surface& surface) const {
    const run::SceneData& data = plan_.scenes[group.plan.scene];
    const Vec2i size = config_.viewports[group.plan.viewport];
    Heading out;
    out.scene_line = data.scene.name + ", camera " + group.path.camera_path().camera + ", " + frames + ", " +
                     std::to_string(size.x) + "x" + std::to_string(size.y);
    if (divisor > 1)
      out.scene_line += ", one of " + std::to_string(divisor) + "x" + std::to_string(divisor) + " pixels";
    if (surface.plane_m)
      out.scene_line += ", all at depth " + short_number(*surface.plane_m) + " m" +
                        (request_.plane_m               ? ""
                         : is_built_in(Library::embree) ? ": there are no triangles"
                                                        : ": no Embree sees surfaces");
    return out;
  }

  void name_case(Heading& heading, const run::CasePlan& case_plan) const {
    const config::PrecisionRequest& precision = config_.precisions[case_plan.precision];
    heading.grid_line = config_.grids[case_plan.grid].name();
    heading.method = config_.assigners[case_plan.assigner].label() + ", " + run::storage_label(config_, case_plan) +
                     (precision.is_lossy() ? ", lights in " + precision.label() : "");
  }

  static std::string frame_text(const Group& group, const view::Frame& frame) {
    char time[32];
    std::snprintf(time, sizeof time, "%.2f", frame.time_s);
    return "frame " + std::to_string(frame.index) + " of 0 to " + std::to_string(group.path.count() - 1) + " (" + time +
           " s)";
  }

  void draw_frame(const Group& group, int index) {
    report_progress(group);
    const PicturedFrame now = prepare(group, index);
    const int divisor = divisor_of(group);
    const Surface surface = surface_of(group, now.frame, divisor);
    const std::vector<float> light = relief(now.frame, surface);
    Heading head = heading(group, frame_text(group, now.frame), divisor, surface);
    draw_depth(group, index, head, {surface, light, 0});
    if (!wants_maps()) return;

    const NeededAt needed(now.frame, surface, config_.threads);
    const Seen seen{surface, light, needed.total()};
    std::vector<Answer> answers;
    for (const run::CasePlan* case_plan : group.cases) answers.emplace_back(config_, *case_plan, now, group.path);
    const auto maps_of = [&](std::size_t at) {
      return pixel_maps(surface, needed, now.frame.ranges().spots.first, answers[at].structure(), config_.threads);
    };
    // All cases have the same scales, so that their pictures are comparable; so each case is evaluated twice.
    std::uint32_t most_lights = 0, most_false = 0;
    std::optional<PixelMaps> only;
    for (std::size_t i = 0; i < answers.size() && !stop_; ++i) {
      PixelMaps maps = maps_of(i);
      most_lights = std::max(most_lights, usual_most(maps, [&](std::size_t at) { return maps.lights(at); }));
      most_false = std::max(most_false, usual_most(maps, [&](std::size_t at) { return maps.false_positives[at]; }));
      if (answers.size() == 1) only = std::move(maps);
    }
    const std::uint32_t top = request_.top.value_or(scale_top(most_lights)), top_false = scale_top(most_false);
    for (std::size_t i = 0; i < answers.size() && !stop_; ++i) {
      const PixelMaps maps = only ? std::move(*only) : maps_of(i);
      const run::CasePlan& case_plan = *group.cases[i];
      name_case(head, case_plan);
      const auto add = [&](Kind kind, const auto& make) {
        if (request_.wants(kind) && !stop_)
          save(group, make(), {names_.of_case(case_plan.name, kind, index), "", kind, index, {case_plan.id}, ""});
      };
      add(Kind::lights, [&] { return lights_figure(head, seen, maps, top); });
      add(Kind::levels, [&] { return levels_figure(head, seen, maps); });
      add(Kind::types, [&] { return types_figure(head, seen, maps); });
      add(Kind::false_positives, [&] { return false_positives_figure(head, seen, maps, top_false); });
      add(Kind::missed, [&] { return missed_figure(head, seen, maps); });
      add(Kind::lists, [&] { return lists_figure(head, seen, maps, list_map(surface, answers[i].structure())); });
    }
  }

  bool wants_maps() const {
    return std::ranges::any_of(request_.kinds, [](Kind kind) { return kind != Kind::depth && kind != Kind::strip; });
  }

  // The same for all grids: drawn once.
  void draw_depth(const Group& group, int index, const Heading& head, const Seen& seen) {
    if (!request_.wants(Kind::depth) || is_on_plane(group)) return;
    const Vec2i size = config_.viewports[group.plan.viewport];
    const std::string viewport =
        config_.viewports.size() > 1 ? "-" + std::to_string(size.x) + "x" + std::to_string(size.y) : "";
    if (depths_.insert({group.plan.scene, group.plan.camera, group.plan.viewport, index}).second)
      save(group, depth_figure(head, seen),
           {names_.of_depth(group.plan.cases.front().name, viewport, index), "", Kind::depth, index,
            cases_in_view(group.plan), ""});
  }

  // The cases of all grids in the same view.
  std::vector<std::string> cases_in_view(const run::GroupPlan& plan) const {
    std::vector<std::string> ids;
    for (const run::GroupPlan& other : plan_.groups)
      if (other.scene == plan.scene && other.camera == plan.camera && other.viewport == plan.viewport)
        for (const run::CasePlan& case_plan : other.cases) ids.push_back(case_plan.id);
    return ids;
  }

  void draw_strips(const Group& group) {
    const int divisor = divisor_for(config_.viewports[group.plan.viewport], k_strip_longest_side);
    std::vector<std::vector<StripFrame>> strips(group.cases.size());
    std::uint32_t most = 0;
    Heading head;
    for (const int index : run::evenly_spaced(k_strip_frames, group.path.count())) {
      if (stop_) return;
      const PicturedFrame now = prepare(group, index);
      const Surface surface = surface_of(group, now.frame, divisor);
      const NeededAt needed(now.frame, surface, config_.threads);
      for (std::size_t i = 0; i < strips.size(); ++i) {
        const Answer answer(config_, *group.cases[i], now, group.path);
        const PixelMaps maps =
            pixel_maps(surface, needed, now.frame.ranges().spots.first, answer.structure(), config_.threads);
        most = std::max(most, usual_most(maps, [&](std::size_t at) { return maps.lights(at); }));
        strips[i].push_back(strip_frame(index, surface, maps));
      }
      if (head.scene_line.empty()) head = heading(group, strip_text(group), divisor, surface);
    }
    for (std::size_t i = 0; i < strips.size() && !stop_; ++i) {
      name_case(head, *group.cases[i]);
      const std::uint32_t top = request_.top.value_or(scale_top(most));
      save(group, strip_figure(head, strips[i], top),
           {names_.of_strip(group.cases[i]->name), "", Kind::strip, {}, {group.cases[i]->id}, ""});
    }
  }

  static std::string strip_text(const Group& group) { return "frames 0 to " + std::to_string(group.path.count() - 1); }

  static StripFrame strip_frame(int index, const Surface& surface, const PixelMaps& maps) {
    StripFrame out{index, surface.image.pixels.size, maps.state, {}, maps.lights_total, maps.surfaces};
    out.lights.reserve(maps.points.size());
    for (std::size_t i = 0; i < maps.points.size(); ++i) out.lights.push_back(maps.lights(i));
    return out;
  }

  void save(const Group& group, const Figure& figure, Picture picture) {
    picture.png = png_of(drawn(figure));
    picture.text = figure.title + ".";
    for (const std::string& note : figure.notes) picture.text += " " + note;
    listener_.on_picture(picture);
    ++done_;
    report_progress(group);
  }

  void report_progress(const Group& group) const {
    if (!listener_.on_progress) return;
    const std::string& name = group.plan.cases.front().name;
    listener_.on_progress(name.substr(0, name.find('/', name.find('/', name.find('/') + 1) + 1)),
                          static_cast<double>(done_) / static_cast<double>(std::max<std::uint64_t>(1, total_)));
  }

  const config::Config& config_;
  const run::Plan& plan_;
  const Request& request_;
  const LongestLists& longest_;
  const Listener& listener_;
  const std::atomic<bool>& stop_;
  std::uint64_t total_ = 0, done_ = 0;
  FileNames names_;
  std::set<std::tuple<std::size_t, std::size_t, std::size_t, int>> depths_;  // drawn: scene, camera, viewport, frame
  std::deque<std::optional<run::FrameDepths>> own_depths_;  // of each scene whose depths no method needs
};

}  // namespace

bool Request::wants(Kind kind) const {
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

Geometries load_geometries(const config::Config& config, const run::Plan& plan, const Request& request) {
  Geometries out(plan.scenes.size());
  if (request.plane_m) return out;
  for (std::size_t i = 0; i < plan.scenes.size(); ++i) {
    if (plan.scenes[i].geometry || config.scenes[i].rig) continue;
    try {
      if (const std::string unseen = missing_library(Library::embree); !unseen.empty()) throw Error("", "", unseen);
      out[i] = scene::load_geometry(plan.scenes[i].scene);
    } catch (const Error& error) {
      out[i].emplace().warnings.push_back("pictures are at one depth, as without triangles: " +
                                          std::string(error.what()));
    }
  }
  return out;
}

std::uint64_t picture_count(const run::Plan& plan, const Request& request) {
  const auto per_frame = static_cast<std::uint64_t>(
      std::ranges::count_if(request.kinds, [](Kind kind) { return kind != Kind::depth && kind != Kind::strip; }));
  std::uint64_t count = 0;
  int longest_path = 0;
  for (const run::GroupPlan& group : plan.groups) {
    const int path = static_cast<int>(plan.scenes[group.scene].paths[group.camera].shots.size());
    longest_path = std::max(longest_path, path);
    const auto frames =
        request.frames == Request::Frames::listed
            ? static_cast<std::uint64_t>(std::ranges::count_if(request.listed, [&](int frame) { return frame < path; }))
            : 1;
    count += frames * (per_frame * group.cases.size() + (request.wants(Kind::depth) ? 1 : 0));
    if (request.wants(Kind::strip)) count += group.cases.size();
  }
  for (const int frame : request.listed)
    if (frame >= longest_path)
      throw Error(
          "", "--image-frames",
          std::to_string(frame) + " is on no path: the longest has frames 0 to " + std::to_string(longest_path - 1));
  return count;
}

void draw_pictures(const config::Config& config, const run::Plan& plan, const Geometries& geometries,
                   const Request& request, const LongestLists& longest, const Listener& listener,
                   const std::atomic<bool>& stop) {
  Drawing(config, plan, geometries, request, longest, listener, stop).draw();
}

}  // namespace clusterbench::pictures
