#pragma once
// The contract of an assigner, and the descriptor by which everything else knows it. Adding one: a file in assigners/
// that defines its descriptor, and one line in registry.inc; or an AssignerRegistration.

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "assign/contract/light_structure.h"
#include "assign/contract/lists.h"
#include "depth/depth_image.h"
#include "grid/grid.h"
#include "view/frame.h"

namespace clusterbench::assign {

using ParamValue = std::variant<bool, double, std::string>;

// One parameter, as configuration, schema, `list` and the report show it.
struct ParamSpec {
  std::string name;
  std::string summary;
  ParamValue default_value;          // the default; its type is the parameter's type
  std::string unit;                  // "" = none
  double min = 0.0, max = 0.0;       // numbers
  std::vector<std::string> choices;  // texts
  bool whole = false;                // numbers: whole ones only
  // Numbers: from here on a method that calls itself conservative is; below, lights can be lost.
  double conservative_from = -std::numeric_limits<double>::infinity();
  bool is_thread_count = false;
  // Added after results with the method were published: at its default it is no part of a case's identity, so that they
  // still compare.
  bool is_late = false;
  // Texts: what earlier versions called a choice, and its name of today. Both may be given; cases keep their identity.
  std::vector<std::pair<std::string, std::string>> former{};
};

// A value as a choice of today, and as it was first called.
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

// Which lights a rig has: what serves none of them is not built.
struct LightKinds {
  bool spots = true, boxes = true;
};
inline LightKinds kinds_of(const view::LightArrays& lights) {
  return {!lights.spots.empty(), !lights.boxes.empty()};
}

// What a method gets of one frame.
struct FrameInput {
  const view::Frame& frame;         // camera and viewport
  const view::LightArrays& lights;  // in the grid's space (grid::space_of)
  // Of each pixel of the viewport; null where the method's descriptor does not ask for it. Nobody's time: a GPU has it
  // from its depth prepass.
  const depth::DepthImage* depth = nullptr;
};

// What a device (a GPU) took for one frame by its own clock, within the time of the assignment.
struct DeviceSpans {
  double upload_ns = 0.0, run_ns = 0.0, readback_ns = 0.0;
};

class Assigner {
 public:
  virtual ~Assigner() = default;

  // Called when the grid changes (a new projection), before assign, with the kinds of light that frames may bring. The
  // grid outlives its use. Makes all that does not depend on the frame; nothing of it may be left to assign. Timed as
  // the build.
  virtual void build(const grid::Grid& grid, const LightKinds& kinds) = 0;
  // For lights of any kind.
  void build(const grid::Grid& grid) { build(grid, LightKinds{}); }

  // Tests of lights against cells (or tiles, or nodes) done by the last assign: counted, not timed, so it can gate
  // exactly.
  virtual std::uint64_t tests_done() const = 0;
  // Pairs of the last assign that single precision could not decide and that were decided at greater cost.
  virtual std::uint64_t fallbacks() const { return 0; }
  // Of the last assign; null where nothing runs on a device.
  virtual const DeviceSpans* device_spans() const { return nullptr; }
  // Scratch memory held now.
  virtual std::size_t scratch_bytes() const = 0;
};

// A method that fills a list per cell. Storages make light structures of them.
class ListAssigner : public Assigner {
 public:
  // In a steady state (as many pairs as before or fewer) it does not allocate. Timed as the assignment.
  virtual void assign(const FrameInput& input, Lists& out) = 0;
};

// A method that leaves a light structure of its own. Write it as an AssignerOf.
class StructureAssigner : public Assigner {
 public:
  // An empty one. Frames that are kept beside each other have a structure each.
  virtual std::unique_ptr<LightStructure> make_structure() const = 0;
  // `out` is one that make_structure() made; it does not refer to this frame or to the assigner, but may to the grid.
  // In a steady state it does not allocate. Timed as the assignment.
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

// What a method answers with.
enum class Answer : std::uint8_t { lists, structure };

// What a method asks for besides camera and lights. What no method asks for is not there: triangles, boxes or the
// structure of the frame before would each be one more member, here and in FrameInput.
struct Needs {
  bool depth = false;  // the depths of the picture's pixels
};

// A method as data: all that everything else knows of it.
struct AssignerDescriptor {
  std::string name;
  std::string summary;
  std::string source;                // paper or engine
  std::vector<grid::Kind> kinds;     // grids that it fills
  bool points = true, spots = true;  // light types that it takes
  bool boxes = false;                // and oriented boxes (decals, probes)
  Needs needs{};
  bool conservative = true;  // never misses a true pair; a miss fails the run. Parameters say when it no longer is
  bool exact = false;        // and reports no pair that is not true
  bool orthographic = true;  // takes orthographic projections
  bool all_pairs = false;    // tests every light against every cell
  // With depth: promises the lights of visible surfaces, and is not asked elsewhere in the view.
  bool at_surfaces = false;
  // Each light is drawn over its pixels, so that no lane of a wave waits for the list of another one.
  bool draws_lights = false;
  // Its own structure holds a list per cell or tile, which a sample reads as it is. Others are searched at each sample.
  bool own_lists = false;
  // Its own structure is the same on every grid: it is measured once, on the first.
  bool own_without_grid = false;
  // A known mistake on purpose, to show what it does: left out where nothing names it.
  bool naive = false;
  // Left out where nothing names it: one of many ways of engines, that default runs need not pay for.
  bool by_name = false;
  std::vector<ParamSpec> params;
  // The forms in which it answers, one or both; null: not in this one.
  std::unique_ptr<ListAssigner> (*make)(const Params& params) = nullptr;
  std::unique_ptr<StructureAssigner> (*make_own)(const Params& params) = nullptr;
  // Why it cannot run on this machine, "" if it can. Null: it always can.
  std::string (*unavailable)(const Params& params) = nullptr;

  bool takes(grid::Kind kind) const;
  bool answers(Answer answer) const;
  // Whether it runs where nothing is named. Those that need depth do not: their rays take long.
  bool is_default() const { return !naive && !by_name && !needs.depth; }
  // Whether samples search its own structure for their lights (a hierarchy, masks of bits): what they read and visit is
  // counted, and no GPU has measured what that costs.
  bool own_is_searched() const { return make_own != nullptr && !own_lists && !draws_lights; }
};

// For descriptors: what makes a method of its parameters.
template <class Method>
std::unique_ptr<ListAssigner> make_list_assigner(const Params& params) {
  return std::make_unique<Method>(params);
}
template <class Method>
std::unique_ptr<StructureAssigner> make_structure_assigner(const Params& params) {
  return std::make_unique<Method>(params);
}

// As the descriptor says, and with no parameter that takes it away.
bool is_conservative(const AssignerDescriptor& descriptor, const Params& params);
// How many threads it shares its work among.
int thread_count(const AssignerDescriptor& descriptor, const Params& params);
// Why it cannot run here; "" if it can.
std::string unavailability(const AssignerDescriptor& descriptor, const Params& params);

// All descriptors: those of registry.inc in its order, then those registered at run time.
std::span<const AssignerDescriptor* const> assigner_descriptors();

// Adds a method to the registry for as long as it lives. Not while configurations are read or run.
class AssignerRegistration {
 public:
  // Throws Error if there is one of this name.
  explicit AssignerRegistration(AssignerDescriptor descriptor);
  ~AssignerRegistration();
  AssignerRegistration(const AssignerRegistration&) = delete;
  AssignerRegistration& operator=(const AssignerRegistration&) = delete;

  const AssignerDescriptor& descriptor() const { return descriptor_; }

 private:
  AssignerDescriptor descriptor_;
};
// nullptr if there is none.
const AssignerDescriptor* find_assigner(const std::string& name);
// Of methods that make the same lists, which is known to be slower without a time: 1 with SIMD, 2 the plain form beside
// one with SIMD, 3 every light against every cell. 0: nothing is known, as of a name that nobody has.
int slowness_of(const std::string& name);
std::vector<std::string> assigner_names();
// Those that run where nothing is named.
std::vector<std::string> default_assigner_names();

}  // namespace clusterbench::assign
