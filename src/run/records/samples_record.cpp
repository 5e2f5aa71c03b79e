// Lights at samples.

#include <cmath>

#include "run/records/parts.h"

namespace clusterbench::run {
namespace {

using result::counted;

result::Waves waves_record(const measure::WaveCounts& waves) {
  const auto per_wave = [&](double sum) { return counted(sum / static_cast<double>(waves.waves)); };
  result::Waves out;
  out.lanes = waves.lanes();
  out.waves = waves.waves;
  out.distinct_lists = {counted(waves.mean_distinct()), static_cast<std::uint64_t>(waves.most_distinct)};
  out.mean_list = per_wave(waves.mean);
  out.longest_list = per_wave(static_cast<double>(waves.longest));
  out.united_lists = per_wave(static_cast<double>(waves.united));
  out.divergence = counted(waves.divergence());
  out.scalarised = counted(waves.scalarised());
  return out;
}

result::Lengths lengths_record(const measure::LengthDistribution& lengths) {
  using result::measured;
  return {measured(lengths.mean_m()), measured(lengths.quantile_m(0.5)), measured(lengths.quantile_m(0.9)),
          measured(lengths.quantile_m(0.99)), measured(lengths.max_m())};
}

result::DepthLengths depth_lengths_record(const measure::DepthRanges::Tiles& tiles) {
  const auto of_kind = [&](measure::ListKind kind) {
    return lengths_record(tiles.lengths[static_cast<std::size_t>(kind)]);
  };
  return {tiles.tiles,
          tiles.pixels,
          of_kind(measure::ListKind::tiled),
          of_kind(measure::ListKind::tiled_2_5d),
          of_kind(measure::ListKind::clusters),
          of_kind(measure::ListKind::explicit_clusters)};
}

std::optional<result::SampleSet>& place_of(measure::SampleSet set, result::SampleSets& sets) {
  switch (set) {
    case measure::SampleSet::opaque:
      return sets.opaque;
    case measure::SampleSet::transparent:
      return sets.transparent;
    case measure::SampleSet::fog:
      return sets.fog;
    case measure::SampleSet::mirror:
      return sets.mirror;
    default:
      return sets.anywhere;
  }
}

}  // namespace

result::SampleSet samples_record(const measure::ShadingCounts& s) {
  result::SampleSet out;
  out.samples = s.samples;
  out.unanswered = s.unanswered;
  out.evaluated = s.evaluated;
  out.needed = s.needed;
  out.missed = s.missed;
  out.missed_in_cells = s.missed - s.missed_outside;
  out.missed_outside = s.missed_outside;
  out.unlit = counted(s.unlit());
  if (s.needed > 0) out.lost_irradiance = counted(s.lost_irradiance());
  out.lost_lux = counted(s.lost_lux / static_cast<double>(s.samples));
  out.overshade = counted(s.comparable_overshade());
  out.reads = s.reads.elements;
  out.read_bytes = s.reads.bytes;
  if (s.worst) out.worst_frame = {static_cast<std::uint64_t>(s.worst->frame), s.worst->missed, s.worst->needed};
  if (!s.darkest) return out;
  out.darkest = {static_cast<std::uint64_t>(s.darkest->frame), counted(s.darkest->lost_lux), {}};
  if (std::isfinite(s.darkest->pixel_x) && std::isfinite(s.darkest->pixel_y))
    out.darkest->pixel = {counted(static_cast<double>(s.darkest->pixel_x)),
                          counted(static_cast<double>(s.darkest->pixel_y))};
  return out;
}

result::SampleSets samples_record(const std::vector<SampleSetResult>& sets) {
  result::SampleSets out;
  for (const SampleSetResult& set : sets) {
    result::SampleSet& record = place_of(set.set, out).emplace(samples_record(set.counts));
    if (set.ground_m) record.ground_m = counted(*set.ground_m);
    if (!set.coherence) continue;
    record.waves.emplace();
    for (const measure::WaveCounts& waves : set.coherence->sizes) record.waves->push_back(waves_record(waves));
  }
  return out;
}

result::DepthRanges depth_ranges_record(const measure::DepthRanges& ranges) {
  return {depth_lengths_record(ranges.slopes), depth_lengths_record(ranges.discontinuities), ranges.outside};
}

std::vector<result::Lookup> lookup_record(const std::vector<measure::LookupCounts>& ways) {
  std::vector<result::Lookup> out;
  for (const measure::LookupCounts& counts : ways)
    out.push_back({measure::name_of(counts.way.logarithm), measure::name_of(counts.way.depth), counts.samples,
                   counts.needed, counts.missed, counts.wrong_samples,
                   static_cast<std::uint64_t>(counts.safe_padding_ulps)});
  return out;
}

}  // namespace clusterbench::run
