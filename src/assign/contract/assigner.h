#pragma once
// The contract of an assigner, and the descriptor through which all other code knows it. To add one: a file in
// assigners/ that defines its descriptor, and one line in registry.inc; or an AssignerRegistration.

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "assign/contract/device_work.h"
#include "assign/contract/light_structure.h"
#include "assign/contract/lists.h"
#include "depth/depth_image.h"
#include "grid/grid.h"
#include "view/frame.h"

namespace clusterbench::assign {

using ParamValue = std::variant<bool, double, std::string>;

// One parameter, as shown by configuration, schema, `list` and the report.
struct ParamSpec {
  std::string name;
  std::string summary;
  ParamValue default_value;          // the default; its type is the parameter's type
  std::string unit;                  // "" = none
  double min = 0.0, max = 0.0;       // numbers
  std::vector<std::string> choices;  // for texts
  bool whole = false;                // for numbers: only whole ones
  // Numbers: a method that is conservative is so only from this value on; below it, lights can be lost.
  double conservative_from = -std::numeric_limits<double>::infinity();
  bool is_thread_count = false;
  // Added after results with the method were published: a default value is left out of a case's identity, so that old
  // and new results still compare.
  bool is_late = false;
  // Texts: former names of choices, with their present names. Both are valid; cases keep their identity.
  std::vector<std::pair<std::string, std::string>> former{};
};

// A value under its present name, and under its first name.
ParamValue current_value(const ParamSpec& spec, const ParamValue& value);
ParamValue first_value(const ParamSpec& spec, const ParamValue& value);

// Resolved parameters: every parameter of the method, defaults filled in.
class Params {
 public:
  Params() = default;
  explicit Params(std::span<const ParamSpec> specs);  // the defaults
  // Throws Error (where = parameter name) for an unknown name, a wrong type or a value that is not allowed.
  Params(std::span<const ParamSpec> specs, const std::map<std::string, ParamValue>& given);

  bool flag(const std::string& name) const { return std::get<bool>(values_.at(name)); }
  double number(const std::string& name) const { return std::get<double>(values_.at(name)); }
  const std::string& text(const std::string& name) const { return std::get<std::string>(values_.at(name)); }
  const std::map<std::string, ParamValue>& values() const { return values_; }

 private:
  std::map<std::string, ParamValue> values_;
};

// The kinds of lights in a rig. Methods build nothing for kinds that are absent.
struct LightKinds {
  bool spots = true, boxes = true;
};
inline LightKinds kinds_of(const view::LightArrays& lights) {
  return {!lights.spots.empty(), !lights.boxes.empty()};
}

// The input of a method for one frame.
struct FrameInput {
  const view::Frame& frame;         // camera and viewport
  const view::LightArrays& lights;  // in the grid's space (grid::space_of)
  // The depth of each pixel of the viewport; null if the method's descriptor does not need it. Its time is not counted:
  // a GPU gets it from its depth prepass.
  const depth::DepthImage* depth = nullptr;
};

// Whether earlier frames change what a method does in a frame. Where they do not, several instances can share the
// frames of a path.
enum class EarlierFrames : std::uint8_t {
  matter,             // its lists may depend on them
  matter_to_scratch,  // only the size of its scratch memory depends on them
  do_not_matter       // the scratch memory is as large as the frame that needs most makes it, in any order
};

class Assigner {
 public:
  virtual ~Assigner() = default;

  // Called before assign when the grid changes (a new projection), with the kinds of light that frames may bring. The
  // grid outlives its use. Computes everything that does not depend on the frame, so that assign does none of it. Timed
  // as the build.
  virtual void build(const grid::Grid& grid, const LightKinds& kinds) = 0;
  // For lights of any kind.
  void build(const grid::Grid& grid) { build(grid, LightKinds{}); }

  // The number of tests of lights against cells (or tiles, or nodes) in the last assign: counted, not timed, so exact
  // limits can be set on it.
  virtual std::uint64_t tests_done() const = 0;
  // Pairs of the last assign that single precision left uncertain and that were decided at greater cost.
  virtual std::uint64_t fallbacks() const { return 0; }
  // Times of the last assign; null if nothing runs on a device.
  virtual const DeviceSpans* device_spans() const { return nullptr; }
  virtual void repeat_on_device(const DeviceRepeats&) {}
  // Measures on its device, by the same clock, as many steps as those of the last assign that do nothing, of which the
  // last writes as many bytes as its result has.
  virtual double device_floor_ns() { return 0.0; }
  // Measures there what the device does of the last build, by doing it again; none if the host does it all.
  virtual std::optional<double> device_build_ns() { return {}; }
  // What the device's driver tells of its shaders.
  virtual std::vector<ShaderStatistic> shader_statistics() const { return {}; }
  // Present size of the scratch memory.
  virtual std::size_t scratch_bytes() const = 0;
  virtual EarlierFrames earlier_frames() const { return EarlierFrames::matter; }
};

// A method that fills one list per cell. Storages convert the lists to light structures.
class ListAssigner : public Assigner {
 public:
  // Does not allocate in a steady state (as many pairs as `out` has room for). `out` may hold any lists: of any earlier
  // frame, and of another method.
  // Timed as the assignment.
  virtual void assign(const FrameInput& input, Lists& out) = 0;
  // Of a method that nobody here has tested (a plug-in's): throws MethodError for lists of the last assign, with lights
  // of these types, that break the rules of Lists, before anything reads them. Not timed.
  virtual void check(const Lists&, const view::LightRanges&) const {}
};

// A method that makes its own light structure. Derive it from AssignerOf.
class StructureAssigner : public Assigner {
 public:
  // An empty structure. Frames that are kept side by side have one structure each.
  virtual std::unique_ptr<LightStructure> make_structure() const = 0;
  // `out` comes from make_structure(). It must not refer to this frame or to the assigner, but may refer to the grid.
  // Does not allocate in a steady state. Timed as the assignment.
  virtual void assign(const FrameInput& input, LightStructure& out) = 0;
};

template <class Structure>
class AssignerOf : public StructureAssigner {
 public:
  std::unique_ptr<LightStructure> make_structure() const final { return std::make_unique<Structure>(); }
  void assign(const FrameInput& input, LightStructure& out) final { fill(input, static_cast<Structure&>(out)); }

 protected:
  virtual void fill(const FrameInput& input, Structure& out) = 0;
};

// The form of a method's result.
enum class Answer : std::uint8_t { lists, structure };

// The inputs that a method needs besides camera and lights. Inputs that no method needs do not exist here: triangles,
// boxes or the structure of the frame before would each be one more member, here and in FrameInput.
struct Needs {
  bool depth = false;  // the depths of the picture's pixels
};

// The file that a method which is not built in was read from, and SHA-256 of all of its files.
struct Origin {
  std::string file, sha256;
};

// A method as data: all other code knows a method only through this.
struct AssignerDescriptor {
  std::string name;
  std::string summary;
  std::string source;                // paper or engine
  std::vector<grid::Kind> kinds;     // grids that it supports
  bool points = true, spots = true;  // supported light types
  bool boxes = false;                // and oriented boxes (decals, probes)
  Needs needs{};
  bool conservative = true;  // never misses a true pair; a miss fails the run. Some parameter values make it false
  bool exact = false;        // and reports no pair that is not true
  bool orthographic = true;  // supports orthographic projections
  bool all_pairs = false;    // tests every light against every cell
  // With depth: complete only for the lights of visible surfaces; other points of the view are not tested.
  bool at_surfaces = false;
  // Each light is drawn over its pixels, so no lane of a wave waits for the list of another lane.
  bool draws_lights = false;
  // Its own structure holds a list per cell or tile, which a sample reads as it is. Otherwise samples search the
  // structure.
  bool own_lists = false;
  // Its own structure is the same on every grid, so it is measured only once, on the first.
  bool own_without_grid = false;
  // Contains a known mistake on purpose, to show its effect: runs only if a configuration names it.
  bool naive = false;
  // Runs only if a configuration names it: a variant of an engine that default runs can omit.
  bool by_name = false;
  // Runs on a device, whose clock times it: the time of the process that waits for it ranks nothing.
  bool on_device = false;
  std::vector<ParamSpec> params;
  // The forms of its result, one or both; null: not available in this form.
  std::function<std::unique_ptr<ListAssigner>(const Params& params)> make = nullptr;
  std::function<std::unique_ptr<StructureAssigner>(const Params& params)> make_own = nullptr;
  // The reason why it cannot run on this machine, "" if it can. Null: it always can.
  std::function<std::string(const Params& params)> unavailable = nullptr;
  // The reason why it cannot run on a grid of its kinds, "" if it can. Null: it can on all.
  std::function<std::string(const grid::Grid& grid)> unfit = nullptr;
  // The plug-in that it comes from; "" for the program's own.
  std::string plugin{};
  // Of a method that is not built in.
  std::optional<Origin> origin{};

  bool takes(grid::Kind kind) const;
  bool answers(Answer answer) const;
  // Does it run if a configuration names no methods? Methods that need depth do not: tracing the rays takes long.
  bool is_default() const { return !naive && !by_name && !needs.depth; }
  // Do samples search its own structure for their lights (a hierarchy, masks of bits)? Then their reads and visits are
  // counted, but no GPU has measured their cost.
  bool own_is_searched() const { return make_own != nullptr && !own_lists && !draws_lights; }
};

// For descriptors: makes a method from its parameters.
template <class Method>
std::unique_ptr<ListAssigner> make_list_assigner(const Params& params) {
  return std::make_unique<Method>(params);
}
template <class Method>
std::unique_ptr<StructureAssigner> make_structure_assigner(const Params& params) {
  return std::make_unique<Method>(params);
}

// From the descriptor, unless a parameter value makes it false.
bool is_conservative(const AssignerDescriptor& descriptor, const Params& params);
// The number of threads that share its work.
int thread_count(const AssignerDescriptor& descriptor, const Params& params);
// The reason why it cannot run here; "" if it can.
std::string unavailability(const AssignerDescriptor& descriptor, const Params& params);

// All descriptors: those of registry.inc in its order, then those registered at run time.
std::span<const AssignerDescriptor* const> assigner_descriptors();

// Adds a method to the registry for as long as this object lives. Not while configurations are read or run.
class AssignerRegistration {
 public:
  // Throws Error if the name is in use.
  explicit AssignerRegistration(AssignerDescriptor descriptor);
  ~AssignerRegistration();
  AssignerRegistration(const AssignerRegistration&) = delete;
  AssignerRegistration& operator=(const AssignerRegistration&) = delete;

  const AssignerDescriptor& descriptor() const { return descriptor_; }

 private:
  AssignerDescriptor descriptor_;
};
// Grows with each registration and each end of one.
std::uint64_t registry_version();
// nullptr if there is none.
const AssignerDescriptor* find_assigner(const std::string& name);
// Among methods that make the same lists, the ones known to be slower without measuring: 1 with SIMD, 2 the plain form
// of a method that also has a SIMD form, 3 every light against every cell. 0: unknown, also for names that do not
// exist.
int slowness_of(const std::string& name);
std::vector<std::string> assigner_names();
// The methods that run if a configuration names none.
std::vector<std::string> default_assigner_names();

}  // namespace clusterbench::assign
