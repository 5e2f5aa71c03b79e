#pragma once
// The shell of a conservative rasterizer: the range of depths that a closed mesh has in each tile of the screen.
//
// The mesh's part in a tile is a polyhedron; its least and greatest depth are at its corners, and these are of three
// kinds (the three cases of coverage of Örtegren and Persson 2016):
//   a vertex of the mesh lies in the tile (the tile contains the triangle, or some of its vertices)
//   an edge of the mesh crosses a side of the tile (partly covered)
//   the ray through a tile's corner pierces a triangle (the triangle covers the tile: depth from the plane's gradient)
// The first two are the ends of the edge's part in the tile. Depths before the first slice or after the last one are
// not removed here, but by the code that uses slices: the part in the tile's pyramid is connected, so clipping its
// range of depths is the same as clipping the mesh at these planes. With the eye in the mesh the range begins at 0.
//
// Conservative: vertices and tile planes are exact input, and every computed depth is widened by the possible error of
// doubles (the bounds are beside the steps). So the range contains the true one, and is wider by some 2^-50 of the
// depths involved unless a triangle is seen edge-on.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "assign/pipeline/bounded_balls.h"
#include "assign/raster/light_mesh.h"
#include "grid/screen_grid.h"

namespace clusterbench::assign {

// An interval of depths, or of positions in the picture; empty until a value is added.
struct Extent {
  double lo = std::numeric_limits<double>::infinity(), hi = -std::numeric_limits<double>::infinity();

  bool empty() const { return !(lo <= hi); }
  void add(double from, double to) {
    lo = std::min(lo, from);
    hi = std::max(hi, to);
  }
};

// The depths that a triangle adds to a tile that it touches: those within the tile, or those of the whole triangle.
enum class Coverage { exact, triangle };

class TileDepths {
 public:
  void build(const grid::ScreenGrid& grid);
  // Finds the ranges of all tiles of `window` (rows and columns within the grid's).
  void find(const LightMesh& mesh, Coverage coverage, const CellBox& window);
  // The range of a tile of that window, in metres along the view axis; empty if the mesh does not touch the tile.
  const Extent& of(int column, int row) const { return ranges_[index_of(column, row)]; }

  // The number of tests of edges against tiles and triangles against corners in the last find().
  std::uint64_t tests_done() const { return tests_; }
  std::size_t capacity_bytes() const;

 private:
  struct Triangle;

  std::size_t index_of(int column, int row) const {
    return static_cast<std::size_t>(row - window_.first.y) * columns_ +
           static_cast<std::size_t>(column - window_.first.x);
  }
  Extent& at(int column, int row) { return ranges_[index_of(column, row)]; }
  void add_edge(const Vec3d& a, const Vec3d& b, const Extent* whole);
  void add_triangle(const Triangle& triangle, Coverage coverage);
  void add_around_corner(int column_line, int row_line, const Extent& depths);

  const grid::Tiles* tiles_ = nullptr;
  CellBox window_;
  std::size_t columns_ = 0;
  std::vector<Extent> ranges_;     // of the window's tiles
  std::vector<Extent> triangles_;  // the depths of whole triangles
  std::uint64_t tests_ = 0;
};

}  // namespace clusterbench::assign
