// The tile planes between rows, looked up. For files that are compiled once per target; included after hwy/highway.h;
// defines its names anew for each target.

#if defined(CLUSTERBENCH_PLANE_TABLES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CLUSTERBENCH_PLANE_TABLES_INL_H
#undef CLUSTERBENCH_PLANE_TABLES_INL_H
#else
#define CLUSTERBENCH_PLANE_TABLES_INL_H
#endif

#include "assign/cull/row_planes.h"
#include "assign/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {

// A value of each tile plane, looked up in registers where they hold all of them.
class PlaneTable {
 public:
  HWY_INLINE PlaneTable(const std::vector<float>& values, int planes)
      : values_(values.data()),
        is_small_(static_cast<std::size_t>(planes) <= RegisterTable::size()),
        table_(LoadU(D(), values_), LoadU(D(), values_ + Lanes(D()))) {}

  HWY_INLINE V at(VI index) const { return is_small_ ? table_.at(index) : gathered(values_, index); }

 private:
  const float* values_;
  bool is_small_;
  RegisterTable table_;
};

struct PlaneTables {
  PlaneTable slope, tilt, inverse_tilt;

  HWY_INLINE explicit PlaneTables(const RowPlanes& planes)
      : slope(planes.slope, planes.rows + 1),
        tilt(planes.tilt, planes.rows + 1),
        inverse_tilt(planes.inverse_tilt, planes.rows + 1) {}
};

}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#endif
