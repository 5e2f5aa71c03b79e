#pragma once
// The contract of an assigner, and the row by which everything else knows it. Adding one: a file in assigners/ that
// defines its row, and one line in registry.inc.

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "assign/lists.h"
#include "grid/grid.h"
#include "view/frame.h"

namespace clusterbench::assign {

using ParamValue = std::variant<bool, double, std::string>;

// One parameter, as configuration, schema, `list` and the report show it.
struct ParamSpec {
  std::string name;
  std::string summary;
  ParamValue standard;               // the default; its type is the parameter's type
  std::string unit;                  // "" = none
  double min = 0.0, max = 0.0;       // numbers
  std::vector<std::string> choices;  // texts
  bool whole = false;                // numbers: whole ones only
};

// Resolved parameters: every parameter of the row, defaults filled in.
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
  bool spots = true;
};
inline LightKinds kinds_of(const view::LightArrays& lights) {
  return {lights.spots > 0};
}

class Assigner {
 public:
  virtual ~Assigner() = default;

  // Called when the grid changes (a new projection), before assign, with the kinds of light that frames may bring. The
  // grid outlives its use. Makes all that does not depend on the frame; nothing of it may be left to assign. Timed as
  // the build.
  virtual void build(const grid::Grid& grid, const LightKinds& kinds) = 0;
  // For lights of any kind.
  void build(const grid::Grid& grid) { build(grid, LightKinds{}); }

  // Fills the lists of one frame. Lights are in the grid's space (grid::space_of). In a steady state (as many pairs as
  // before or fewer) it does not allocate. Timed as the assignment.
  virtual void assign(const view::LightArrays& lights, Lists& out) = 0;

  // Light-cell tests done by the last assign: counted, not timed, so it can gate exactly.
  virtual std::uint64_t tests_done() const = 0;
  // Pairs of the last assign that single precision could not decide and that were decided at greater cost.
  virtual std::uint64_t fallbacks() const { return 0; }
  // Scratch memory held now.
  virtual std::size_t scratch_bytes() const = 0;
};

struct AssignerRow {
  std::string name;
  std::string summary;
  std::string source;                // paper or engine
  std::vector<grid::Kind> kinds;     // grids that it fills
  bool points = true, spots = true;  // light types that it takes
  bool needs_depth = false;
  bool conservative = true;  // never misses a true pair; a miss fails the run
  bool exact = false;        // and reports no pair that is not true
  bool orthographic = true;  // takes orthographic projections
  bool all_pairs = false;    // tests every light against every cell
  // A known mistake on purpose, to show what it does: left out where nothing names it.
  bool naive = false;
  std::vector<ParamSpec> params;
  std::unique_ptr<Assigner> (*make)(const Params& params);

  bool takes(grid::Kind kind) const;
};

// As the row says, and with no parameter that takes it away (an inflation below 1).
bool is_conservative(const AssignerRow& row, const Params& params);

// All rows in registry order.
std::span<const AssignerRow* const> assigner_rows();
// nullptr if there is none.
const AssignerRow* find_assigner(const std::string& name);
std::vector<std::string> assigner_names();
// Those that run where nothing is named: all but the naive ones.
std::vector<std::string> standard_assigner_names();

}  // namespace clusterbench::assign
