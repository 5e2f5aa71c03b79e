#pragma once
// Parts that records of several kinds share.

#include "result/fields.h"

namespace clusterbench::result {

using Pair = std::array<double, 2>;
using Sides = std::array<double, 4>;
using Size2 = std::array<std::int64_t, 2>;
using Counts2 = std::array<std::uint64_t, 2>;
using Counts3 = std::array<std::uint64_t, 3>;

struct CellIndex : Counts3 {
  static constexpr const char* k_definition = "cell";
  static About about() { return About("Cell as [x, y, z]", "cell index", "one cell"); }
};

struct Vector : std::array<double, 3> {
  static constexpr const char* k_definition = "vector";
  static About about() { return About("[x, y, z]").finite().as_fraction(); }
};
using Matrix = std::array<Vector, 3>;

struct Interval : Pair {
  static constexpr const char* k_definition = "interval";
  static About about() {
    return About(
        "95 % interval, [low, high]: of times Student's t between three launches or more, or the bootstrap of six "
        "rounds or more of one; null where it is unknown");
  }
};

struct Spread {
  static constexpr const char* k_definition = "spread";
  static About about() { return About("Percentiles are nearest-rank: values that occur"); }
  RECORD(Spread);
  FIELD(double, mean, "Arithmetic mean");
  FIELD(double, p50, "Median");
  FIELD(double, p95, "95th percentile");
  FIELD(double, p99, "99th percentile");
  FIELD(double, max, "Largest");
  END_RECORD;
};

struct MeanMax {
  static constexpr const char* k_definition = "mean_max";
  RECORD(MeanMax);
  FIELD(double, mean, "Arithmetic mean");
  FIELD(double, max, "Largest");
  END_RECORD;
};

struct HighWater {
  static constexpr const char* k_definition = "high_water";
  RECORD(HighWater);
  FIELD(std::uint64_t, high_water, "Largest of all frames");
  FIELD(std::uint64_t, theoretical_max, "If every light were in every cell");
  FIELD(std::uint64_t, recommended,
        "What to allocate: high water x allocation.margin of the configuration, at most theoretical_max");
  END_RECORD;
};

struct Churn {
  static constexpr const char* k_definition = "churn";
  static About about() { return About("", "pairs", "the steps"); }
  RECORD(Churn);
  FIELD(std::uint64_t, total, "Sum over all steps");
  FIELD(double, mean, "Mean per step");
  FIELD(std::uint64_t, max, "In the step with the most");
  END_RECORD;
};

struct Time {
  static constexpr const char* k_definition = "time";
  static About about() { return About("", "ns", "the rounds"); }
  RECORD(Time);
  FIELD(double, median, "Median");
  FIELD(double, mad, "Median absolute deviation");
  FIELD(double, min, "Time of the fastest round");
  FIELD(double, p95, "95th percentile");
  FIELD(Interval, ci95, "95 % interval of the median");
  FIELD(std::vector<double>, samples, "One per round, in the order measured");
  END_RECORD;
};

struct PerFrame {
  static constexpr const char* k_definition = "per_frame";
  static About about() { return About("", "", "the counted frames, in user space"); }
  RECORD(PerFrame);
  FIELD(double, assign,
        About("Instructions of assignment, with the builds that the frames need").finite().at_least(0).as_fraction());
  FIELD(std::optional<double>, convert,
        About("Instructions of conversion to the storage; absent where a method leaves its own structure")
            .finite()
            .at_least(0)
            .as_fraction());
  FIELD(std::optional<double>, pre_cull,
        About("Instructions of the pre-cull; absent where there is none").finite().at_least(0).as_fraction());
  FIELD(std::optional<double>, frame,
        About("Instructions of pre-cull, assignment and conversion together; absent in older results, and of cycles")
            .finite()
            .at_least(0)
            .as_fraction());
  END_RECORD;
};

struct Extremes {
  static constexpr const char* k_definition = "extremes";
  RECORD(Extremes);
  FIELD(double, min, "Smallest");
  FIELD(double, mean, "Mean");
  FIELD(double, max, "Largest");
  END_RECORD;
};

struct BeforeAfter {
  static constexpr const char* k_definition = "before_after";
  static About about() { return About("", Compares::follows); }
  RECORD(BeforeAfter);
  FIELD(std::uint64_t, before, "Before");
  FIELD(std::uint64_t, after, "After", Compares::cost);
  FIELD(double, removed, "Share that is taken out; null where there is none", "share of 1");
  END_RECORD;
};

struct Lengths {
  static constexpr const char* k_definition = "lengths";
  static About about() { return About("Of depth, along the view's -z", "m"); }
  RECORD(Lengths);
  FIELD(double, mean, "Of the pixels; null without pixels, as all of these");
  FIELD(double, p50, "Half of the pixels have at most this; p50, p90 and p99 are rounded up, by a sixteenth at most");
  FIELD(double, p90, "90 % have at most this");
  FIELD(double, p99, "99 % have at most this");
  FIELD(double, max, "The longest");
  END_RECORD;
};

}  // namespace clusterbench::result
