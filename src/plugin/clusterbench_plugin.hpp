// Plug-ins in C++17: a class for each method, and one line that exports them. Header only; needs clusterbench_plugin.h
// and the standard library, and nothing of the program. Exceptions end here: each becomes a status and its text.
//
//   class Tiles : public clusterbench::sdk::Method {
//    public:
//     static clusterbench::sdk::Description description();
//     explicit Tiles(const clusterbench::sdk::Values& values);
//     void build(const clusterbench_grid& grid, std::uint32_t light_types) override;
//     void assign(const clusterbench_frame&, const clusterbench_lights& lights, clusterbench_lists& out) override;
//   };
//   CLUSTERBENCH_PLUGIN("acme", "Methods of Acme's renderer", "1.0", Tiles)
//
// docs/plugins.md has a complete one. clusterbench_plugin.h says what all numbers mean.
#ifndef CLUSTERBENCH_PLUGIN_HPP
#define CLUSTERBENCH_PLUGIN_HPP

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <deque>
#include <exception>
#include <initializer_list>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "clusterbench_plugin.h"

// Hidden: two plug-ins that were built with different versions of this header share none of its functions and tables.
namespace clusterbench {
#pragma GCC visibility push(hidden)
namespace sdk {

// A parameter: number("inflation", 1.0, 0.0, 100.0).says("...").in("m").
class Parameter {
 public:
  Parameter(std::string name, std::uint32_t type) : name_(std::move(name)) { data_.type = type; }

  Parameter& says(std::string summary) { return set(summary_, std::move(summary)); }
  Parameter& in(std::string unit) { return set(unit_, std::move(unit)); }
  Parameter& whole() { return add_flag(CLUSTERBENCH_PARAMETER_WHOLE); }
  // The number of threads that share the work of assign().
  Parameter& counts_threads() { return add_flag(CLUSTERBENCH_PARAMETER_WHOLE | CLUSTERBENCH_PARAMETER_THREADS); }
  // Below this value a conservative method may lose lights.
  Parameter& conservative_from(double value) {
    data_.conservative_from = value;
    return add_flag(CLUSTERBENCH_PARAMETER_CONSERVATIVE_FROM);
  }

  // The same for C; refers to this object.
  clusterbench_parameter data() const {
    clusterbench_parameter out = data_;
    out.struct_size = sizeof out;
    out.choice_count = static_cast<std::uint32_t>(choices_.size());
    out.name = name_.c_str();
    out.summary = summary_.c_str();
    out.unit = unit_.c_str();
    out.default_text = default_text_.c_str();
    out.choices = choices_.data();
    return out;
  }

 private:
  friend Parameter flag(std::string, bool);
  friend Parameter number(std::string, double, double, double);
  friend Parameter text(std::string, std::string, std::initializer_list<const char*>);

  Parameter& set(std::string& member, std::string value) {
    member = std::move(value);
    return *this;
  }
  Parameter& add_flag(std::uint32_t bits) {
    data_.flags |= bits;
    return *this;
  }

  std::string name_, summary_, unit_, default_text_;
  std::vector<const char*> choices_;
  clusterbench_parameter data_{};
};

inline Parameter flag(std::string name, bool standard) {
  Parameter out(std::move(name), CLUSTERBENCH_PARAMETER_FLAG);
  out.data_.default_number = standard ? 1.0 : 0.0;
  return out;
}

// Takes values from `least` to `most`.
inline Parameter number(std::string name, double standard, double least, double most) {
  Parameter out(std::move(name), CLUSTERBENCH_PARAMETER_NUMBER);
  out.data_.default_number = standard;
  out.data_.min = least;
  out.data_.max = most;
  return out;
}

// Takes one of `choices`, which are literals.
inline Parameter text(std::string name, std::string standard, std::initializer_list<const char*> choices) {
  Parameter out(std::move(name), CLUSTERBENCH_PARAMETER_TEXT);
  out.default_text_ = std::move(standard);
  out.choices_ = choices;
  return out;
}

// A method as data: the members of clusterbench_method.
struct Description {
  std::string name, summary, source;
  std::uint32_t grid_kinds = CLUSTERBENCH_FRUSTUM;
  std::uint32_t light_types = CLUSTERBENCH_POINTS | CLUSTERBENCH_SPOTS;
  std::uint32_t flags = CLUSTERBENCH_CONSERVATIVE;
  std::uint32_t needs = 0;
  std::vector<Parameter> parameters = {};
};

// The values of an instance's parameters.
class Values {
 public:
  Values(const clusterbench_value* values, std::uint32_t count) : values_(values), count_(count) {}

  bool flag(const char* name) const { return of(name).number != 0.0; }
  double number(const char* name) const { return of(name).number; }
  std::string text(const char* name) const { return of(name).text; }

 private:
  const clusterbench_value& of(const char* name) const {
    const auto* found = std::find_if(
        values_, values_ + count_, [&](const clusterbench_value& value) { return std::strcmp(value.name, name) == 0; });
    if (found == values_ + count_) throw std::invalid_argument(std::string("asks for an unknown parameter ") + name);
    return *found;
  }

  const clusterbench_value* values_;
  std::uint32_t count_;
};

// Thrown by assign(): this many numbers need room in lists.lights.
struct More {
  std::uint64_t capacity;
};

// Derive from it; the class also has `static Description description()` and a constructor of Values.
class Method {
 public:
  virtual ~Method() = default;
  virtual void build(const clusterbench_grid& grid, std::uint32_t light_types) = 0;
  virtual void assign(const clusterbench_frame& frame, const clusterbench_lights& lights, clusterbench_lists& out) = 0;
};

// ---- Steps that many methods share.

inline std::uint32_t light_count(const clusterbench_lights& lights) {
  return lights.point_count + lights.spot_count + lights.box_count;
}

// The light's radius, larger by this many units of 2^-24 of its reach. 2 cover the roundings of the numbers as they
// are given; a method adds those of its own steps.
inline float padded_radius(const clusterbench_lights& lights, std::uint32_t light, float roundoffs) {
  const float radius = lights.radius[light];
  return radius > 0.0f && roundoffs != 0.0f ? radius + roundoffs * 0x1p-24f * lights.reach[light] : radius;
}

// A box along the axes of the grid's space.
struct Box {
  float lo[3], hi[3];
};

// The squared distance of a point to it; 0 inside.
inline float squared_distance(const Box& box, float x, float y, float z) {
  const float point[3] = {x, y, z};
  float sum = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const float apart = std::max(std::max(box.lo[axis] - point[axis], point[axis] - box.hi[axis]), 0.0f);
    sum += apart * apart;
  }
  return sum;
}

struct CellPlace {
  std::uint32_t x, y, z;
};
inline CellPlace place_of(const clusterbench_grid& grid, std::uint32_t cell) {
  return {cell % grid.cells[0], cell / grid.cells[0] % grid.cells[1], cell / grid.cells[0] / grid.cells[1]};
}

// Of cascades: does it lie in the box of the next finer level? It has no space then.
inline bool is_hole(const clusterbench_grid& grid, std::uint32_t cell) {
  if (grid.kind != CLUSTERBENCH_CASCADES) return false;
  const CellPlace at = place_of(grid, cell);
  const std::uint32_t depth = grid.cells[2] / grid.levels;
  const auto is_inner = [](std::uint32_t i, std::uint32_t count) { return 4 * i >= count && 4 * i < 3 * count; };
  return at.z >= depth && is_inner(at.x, grid.cells[0]) && is_inner(at.y, grid.cells[1]) && 2 * (at.z % depth) < depth;
}

namespace detail {

// Doubles in, the enclosing floats out. A product or quotient of floats in doubles is off by a part of what this
// adds.
struct Interval {
  double lo, hi;
};
inline float below(double value) {
  const float near = static_cast<float>(value);
  return std::nextafter(near, -std::numeric_limits<float>::infinity());
}
inline float above(double value) {
  const float near = static_cast<float>(value);
  return std::nextafter(near, std::numeric_limits<float>::infinity());
}
inline Box outward(Interval x, Interval y, Interval z) {
  return {{below(x.lo), below(y.lo), below(z.lo)}, {above(x.hi), above(y.hi), above(z.hi)}};
}
// Of slopes and depths.
inline Interval product(Interval slopes, Interval depths) {
  return {std::min(slopes.lo * depths.lo, slopes.lo * depths.hi),
          std::max(slopes.hi * depths.lo, slopes.hi * depths.hi)};
}
inline double largest_square(Interval values) {
  return std::max(values.lo * values.lo, values.hi * values.hi);
}

inline Box cascade_box(const clusterbench_grid& grid, CellPlace at) {
  const std::uint32_t depth = grid.cells[2] / grid.levels;
  const double edge = std::ldexp(static_cast<double>(grid.finest), static_cast<int>(at.z / depth));
  const auto times = [edge](std::uint32_t n, std::uint32_t less) { return (static_cast<double>(n) - less) * edge; };
  const std::uint32_t half_x = grid.cells[0] / 2, half_y = grid.cells[1] / 2, k = at.z % depth;
  return outward({times(at.x, half_x), times(at.x + 1, half_x)}, {-times(at.y + 1, half_y), -times(at.y, half_y)},
                 {-times(k + 1, 0), -times(k, 0)});
}

inline Box tile_box(const clusterbench_grid& grid, CellPlace at) {
  const Interval x{grid.x[at.x], grid.x[at.x + 1]}, y{grid.y[at.y + 1], grid.y[at.y]};
  Interval depth{grid.z[at.z], grid.z[at.z + 1]};
  if (grid.kind == CLUSTERBENCH_DISTANCE)  // the least depth is in the corner that is farthest from the axis
    depth.lo *= (1.0 - 0x1p-40) / std::sqrt(1.0 + largest_square(x) + largest_square(y));
  if (grid.orthographic != 0) return outward(x, y, {-depth.hi, -depth.lo});
  return outward(product(x, depth), product(y, depth), {-depth.hi, -depth.lo});
}

}  // namespace detail

// A box around a cell, rounded outward. Not for holes.
inline Box cell_box(const clusterbench_grid& grid, std::uint32_t cell) {
  const CellPlace at = place_of(grid, cell);
  if (grid.kind == CLUSTERBENCH_CASCADES) return detail::cascade_box(grid, at);
  if (grid.kind != CLUSTERBENCH_WORLD) return detail::tile_box(grid, at);
  return {{grid.x[at.x], grid.y[at.y], grid.z[at.z]}, {grid.x[at.x + 1], grid.y[at.y + 1], grid.z[at.z + 1]}};
}

// Collects pairs light by light, in ascending order of lights, and sorts them by cell. Keeps its memory between
// frames.
class Pairs {
 public:
  void start(std::uint32_t cell_count) {
    pairs_.clear();
    counts_.assign(cell_count + std::size_t{1}, 0);
  }
  void add(std::uint32_t cell, std::uint32_t light) {
    pairs_.push_back({cell, light});
    ++counts_[cell + std::size_t{1}];
  }
  // Throws More if there is too little room.
  void finish(clusterbench_lists& out) {
    if (pairs_.size() > out.capacity) throw More{pairs_.size()};
    for (std::size_t i = 1; i < counts_.size(); ++i) counts_[i] += counts_[i - 1];
    std::copy(counts_.begin(), counts_.end(), out.begin);
    for (const Pair& pair : pairs_) out.lights[counts_[pair.cell]++] = pair.light;
    out.count = pairs_.size();
  }
  std::size_t bytes() const { return pairs_.capacity() * sizeof(Pair) + counts_.capacity() * sizeof(std::uint32_t); }

 private:
  struct Pair {
    std::uint32_t cell, light;
  };
  std::vector<Pair> pairs_;
  std::vector<std::uint32_t> counts_;
};

// ---- From classes to the tables of clusterbench_plugin.h.

namespace detail {

inline clusterbench_status fail(clusterbench_error* error, clusterbench_status status, const char* text) {
  if (error == nullptr || error->capacity == 0) return status;
  const std::size_t length = std::min<std::size_t>(std::strlen(text), error->capacity - 1);
  std::memcpy(error->text, text, length);
  error->text[length] = '\0';
  return status;
}

// Calls `work`; what it throws becomes a status.
template <class Work>
clusterbench_status caught(clusterbench_error* error, const Work& work) noexcept {
  try {
    work();
    return CLUSTERBENCH_OK;
  } catch (const std::bad_alloc&) {
    return CLUSTERBENCH_OUT_OF_MEMORY;
  } catch (const std::exception& thrown) {
    return fail(error, CLUSTERBENCH_FAILED, thrown.what());
  } catch (...) {
    return fail(error, CLUSTERBENCH_FAILED, "threw what is no std::exception");
  }
}

// The table of a method class, made once.
template <class M>
class Table {
 public:
  static const clusterbench_method* get() {
    static const Table table;
    return &table.data_;
  }

 private:
  Table() : description_(M::description()) {
    for (const Parameter& parameter : description_.parameters) parameters_.push_back(parameter.data());
    for (const clusterbench_parameter& parameter : parameters_) pointers_.push_back(&parameter);
    data_.struct_size = sizeof data_;
    data_.grid_kinds = description_.grid_kinds;
    data_.light_types = description_.light_types;
    data_.needs = description_.needs;
    data_.flags = description_.flags;
    data_.parameter_count = static_cast<std::uint32_t>(pointers_.size());
    data_.name = description_.name.c_str();
    data_.summary = description_.summary.c_str();
    data_.source = description_.source.c_str();
    data_.parameters = pointers_.data();
    data_.create = create;
    data_.build = build;
    data_.assign = assign;
    data_.destroy = destroy;
  }

  static clusterbench_status create(const clusterbench_method* method, const clusterbench_value* values,
                                    std::uint32_t count, void** instance, clusterbench_error* error) {
    const clusterbench_status known = clusterbench_check_values(method, values, count, error);
    if (known != CLUSTERBENCH_OK) return known;
    return caught(error, [&] { *instance = static_cast<Method*>(new M(Values(values, count))); });
  }
  static clusterbench_status build(void* instance, const clusterbench_grid* grid, std::uint32_t light_types,
                                   clusterbench_error* error) {
    return caught(error, [&] { static_cast<Method*>(instance)->build(*grid, light_types); });
  }
  static clusterbench_status assign(void* instance, const clusterbench_frame* frame, const clusterbench_lights* lights,
                                    clusterbench_lists* lists, clusterbench_error* error) {
    bool needs_more = false;
    const clusterbench_status status = caught(error, [&] {
      try {
        static_cast<Method*>(instance)->assign(*frame, *lights, *lists);
      } catch (const More& more) {
        lists->count = more.capacity;
        needs_more = true;
      }
    });
    return needs_more ? static_cast<clusterbench_status>(CLUSTERBENCH_MORE) : status;
  }
  static void destroy(void* instance) { delete static_cast<Method*>(instance); }

  Description description_;
  std::vector<clusterbench_parameter> parameters_;
  std::vector<const clusterbench_parameter*> pointers_;
  clusterbench_method data_{};
};

template <class... Methods>
const clusterbench_plugin* plugin(const char* id, const char* name, const char* version) {
  static const clusterbench_method* const methods[] = {Table<Methods>::get()...};
  static const clusterbench_plugin data{sizeof(clusterbench_plugin),
                                        CLUSTERBENCH_PLUGIN_MAJOR,
                                        CLUSTERBENCH_PLUGIN_MINOR,
                                        static_cast<std::uint32_t>(sizeof...(Methods)),
                                        id,
                                        name,
                                        version,
                                        methods};
  return &data;
}

}  // namespace detail
}  // namespace sdk
#pragma GCC visibility pop
}  // namespace clusterbench

// Once in a plug-in: CLUSTERBENCH_PLUGIN(id, name, version, Method...).
#define CLUSTERBENCH_PLUGIN(id, name, version, ...)                                                               \
  extern "C" CLUSTERBENCH_EXPORT const clusterbench_plugin* clusterbench_plugin_entry(const clusterbench_host*) { \
    try {                                                                                                         \
      return clusterbench::sdk::detail::plugin<__VA_ARGS__>(id, name, version);                                   \
    } catch (...) {                                                                                               \
      return nullptr;                                                                                             \
    }                                                                                                             \
  }

#endif
