#include "assign/rows/orthographic_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assign/rows/orthographic_rows.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per target
#include <hwy/highway.h>

#include "assign/rows/batch_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace clusterbench::assign {
namespace HWY_NAMESPACE {
namespace {

// One ball per lane, through the rows of one slice.
class FlatBatch {
 public:
  // `indices`: a vector of them; `wanted`: the lanes that hold a ball.
  HWY_INLINE FlatBatch(const RowPlanes& planes, const VisibleBalls& visible, int slice, const std::uint32_t* indices,
                       M wanted)
      : planes_(planes), wanted_(wanted) {
    const VI at = BitCast(DI(), LoadU(DU(), indices));
    x_ = gathered(visible.x, at);
    y_ = gathered(visible.y, at);
    radius_ = gathered(visible.radius, at);
    slack_ = gathered(visible.slack, at);
    const auto k = static_cast<std::size_t>(slice);
    const V away = gap(all(planes.depth[k]), gathered(visible.depth, at), all(planes.depth[k + 1]));
    square_ = (radius_ - away) * (radius_ + away);
    const V along = farther_end(gathered(visible.depth, at), planes.depth[k], planes.depth[k + 1]);
    const V across = farther_end(x_, planes.left, planes.right), up = farther_end(y_, bottom(), planes.slope.front());
    const V farthest = across * across + up * up + along * along;
    least_area_ = least_area_of(radius_, slack_, all(planes.columns_per_slope), farthest);
    lights_ = GatherIndex(DU(), visible.light.data(), at);
  }

  HWY_INLINE void find(BatchSpans& out) const {
    start(out);
    const DU du;
    for (int row = out.first_row; row <= out.last_row; ++row) {
      const auto r = static_cast<std::size_t>(row);
      const VU columns = columns_of(r);
      const auto wanted = Ne(columns, Set(du, BatchRows::k_none));
      const VU listed = compressed(du, columns, wanted);
      const auto size = static_cast<std::uint32_t>(CountTrue(du, wanted));
      StoreU(listed, du, out.columns.data() + out.count);
      StoreU(compressed(du, lights_, wanted), du, out.lights.data() + out.count);
      list_uncertain(listed, size, out.count, out);
      out.sizes[r] = size;
      out.count += size;
    }
  }

 private:
  float bottom() const { return planes_.slope[static_cast<std::size_t>(planes_.rows)]; }

  // The rows between the disk's top and bottom.
  HWY_INLINE void start(BatchSpans& out) const {
    const V zero = Zero(D()), half = Sqrt(Max(square_, zero));
    const V scale = all(planes_.rows_per_slope), tolerance = all(planes_.row_tolerance),
            top = all(planes_.slope.front());
    const V high = Min(y_ + half, top), low = Max(y_ - half, all(bottom()));
    const M touches = And(And(wanted_, square_ >= zero), low <= high);
    const V from = Max((top - high) * scale - tolerance, zero);
    const V to = (top - low) * scale + tolerance;
    const VI last_row = all_int(planes_.rows - 1);
    const VI first = Min(ConvertTo(DI(), from), last_row), last = Min(ConvertTo(DI(), to), last_row);
    const VI count = IfThenElseZero(RebindMask(DI(), touches), last - first + all_int(1));
    start_batch(planes_.rows, first, count, out);
  }

  HWY_INLINE VU columns_of(std::size_t row) const {
    const V away = gap(all(planes_.slope[row + 1]), y_, all(planes_.slope[row]));
    const V square = square_ - away * away, zero = Zero(D());
    const V half = Sqrt(Max(square, zero));
    // Beside the picture a chord says nothing of what the ball has in it.
    const auto chord_square_in_picture = [&] {
      const V beside = gap(all(planes_.left), x_, all(planes_.right));
      return square - beside * beside;
    };
    return columns_between(
        planes_, x_ - half, x_ + half, And(wanted_, square >= zero), least_area_, [](V, V) { return all(1.0f); },
        [&](V inwards, V steepness) {
          return is_certain_by_chord(chord_square_in_picture(), inwards, radius_, slack_,
                                     all(planes_.columns_per_slope), steepness);
        });
  }

  const RowPlanes& planes_;
  M wanted_;
  V x_, y_, radius_, slack_;
  V square_;  // of the disk's radius where the ball is nearest to its middle within the slice
  V least_area_;
  VU lights_;
};

void orthographic_rows(const RowPlanes& planes, const VisibleBalls& visible, std::span<const BallsOfSlice> balls,
                       RowBatches& out) {
  for (std::size_t i = 0; i < balls.size(); ++i)
    FlatBatch(planes, visible, balls[i].slice, balls[i].indices, FirstN(D(), balls[i].count)).find(out.batches[i]);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace clusterbench::assign
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clusterbench::assign {

HWY_EXPORT(orthographic_rows);

void find_orthographic_rows(const RowPlanes& planes, const VisibleBalls& visible, std::span<const BallsOfSlice> balls,
                            RowBatches& out) {
  HWY_DYNAMIC_DISPATCH(orthographic_rows)(planes, visible, balls, out);
}

}  // namespace clusterbench::assign
#endif
