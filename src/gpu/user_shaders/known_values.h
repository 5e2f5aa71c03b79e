#pragma once
// What a shader may be told of a frame, by name: matrices, the grid's numbers and its lookup, numbers of lights.

#include <map>
#include <string>
#include <vector>

#include "assign/contract/assigner.h"
#include "gpu/user_shaders/formula.h"
#include "result/documents/shader.h"

namespace clusterbench::gpu {

// Names of single numbers, which formulas may use, and of several numbers, with what each is. `is_of_grid`: the same
// until the projection changes.
struct KnownValue {
  const char* name;
  std::size_t numbers;  // 0: as many as there are boundaries
  bool is_of_grid;
  const char* meaning;
};
std::vector<KnownValue> known_values();

// The names that formulas of a method may use: known numbers and its parameters. `only_of_grid`: without those that
// change from frame to frame.
std::vector<std::string> number_names(const result::ShaderMethod& method, bool only_of_grid = false);

class FrameValues {
 public:
  // Of a grid with tiles.
  FrameValues(const result::ShaderMethod& method, const assign::Params& params, const view::Frame& frame,
              const grid::ScreenGrid& grid, const view::LightRanges& lights);

  NumberOf number() const;
  // Of a known value, or of a formula. Throws Error ("", `where`) for slice_scale and slice_bias of slices that follow
  // no formula.
  std::vector<double> numbers(const std::string& is, const std::string& where) const;

 private:
  void add_grid(const grid::ScreenGrid& grid);
  void add_matrices(const result::ShaderCamera& camera, const view::Frame& frame);
  void add_matrix(const char* name, const Mat4d& matrix, bool is_by_rows);

  std::map<std::string, std::vector<double>> values_;
};

// View space as a shader has it: +1, or -1 where it looks along +z.
double depth_sign(const result::ShaderMethod& method);

}  // namespace clusterbench::gpu
