#pragma once
// Lists compared with the truth, and lights that samples find in them.

#include "result/shared_parts.h"

namespace clusterbench::result {

struct WorstSampledFrame {
  RECORD(WorstSampledFrame);
  FIELD(std::uint64_t, frame, "Number of the frame on the camera's path, from 0", "frame", "one frame");
  FIELD(std::uint64_t, missed, "Missed lights at this frame's samples", "lights", "one frame");
  FIELD(std::uint64_t, needed, "Needed lights at this frame's samples", "lights", "one frame");
  END_RECORD;
};

struct DarkestSample {
  RECORD(DarkestSample);
  FIELD(std::uint64_t, frame, "Number of the frame on the camera's path, from 0", "frame", "one sample");
  FIELD(double, lost_lux, "Irradiance that the sample loses", "lx", "one sample");
  FIELD(std::optional<Pair>, pixel,
        About("Its position in the picture, from the top left; absent behind the eye", "px", "one sample").finite());
  END_RECORD;
};

struct DistinctLists {
  RECORD(DistinctLists);
  FIELD(double, mean, "Of a wave", "lists");
  FIELD(std::uint64_t, max, "Of a wave", "lists");
  END_RECORD;
};

struct Waves {
  RECORD(Waves);
  FIELD(std::int64_t, lanes, "Pixels of a wave: 32 (8 x 4) or 64 (8 x 8)", "pixels", "one wave");
  FIELD(std::uint64_t, waves, "With a surface in one of their pixels at least; only such pixels count", "waves");
  FIELD(DistinctLists, distinct_lists, "Different lists within a wave");
  FIELD(double, mean_list,
        "Length of a wave's lists, mean over its lanes and then over waves: steps if no lane waited for another",
        "lights", Compares::cost);
  FIELD(double, longest_list, "Longest list of a wave, mean over waves: steps until its last lane is done", "lights",
        Compares::cost);
  FIELD(double, united_lists,
        "Lights that any lane of a wave has, mean over waves: steps of a loop that all lanes share (scalarised)",
        "lights", Compares::cost);
  FIELD(double, divergence, "Sum over waves of the longest list by the sum of the mean ones; 1: no lane waits",
        "ratio");
  FIELD(double, scalarised, "Sum over waves of the united lists by the sum of the mean ones", "ratio");
  END_RECORD;
};

struct SampleSet {
  static constexpr const char* k_definition = "sample_set";
  static About about() { return About("What a shader would loop over at the points of a set", Compares::cost); }
  RECORD(SampleSet);
  FIELD(std::uint64_t, samples, "Points of the set", "samples", Compares::fixed);
  FIELD(std::optional<std::uint64_t>, unanswered,
        About("Samples at which the light structure has no answer: outside of its cells, beside the picture, behind "
              "the eye",
              "samples")
            .late());
  FIELD(std::uint64_t, evaluated, "Lights that the light structure gives at the samples", "lights");
  FIELD(std::uint64_t, needed, "Lights that reach the samples", "lights", Compares::fixed);
  FIELD(std::uint64_t, missed,
        "Of needed, those that the light structure does not give, for any reason: no pair, dropped, or outside of the "
        "grid",
        "lights");
  FIELD(std::optional<std::uint64_t>, missed_in_cells,
        About("Of missed, at samples inside of the grid: the cell lacks the light, or its storage dropped it", "lights")
            .late());
  FIELD(std::optional<std::uint64_t>, missed_outside,
        About("Of missed, at samples outside of the grid, mostly beyond its far end", "lights").late());
  FIELD(double, unlit, "missed / needed, 0 to 1; null where nothing is needed", "share of 1");
  FIELD(double, lost_irradiance,
        "Share of the irradiance (lux, on a surface that faces the light) that missed lights carry: intensity times "
        "the colour's luminance (Rec. 709), attenuated as KHR_lights_punctual has it, with the range's window and a "
        "spot's falloff. Without directional lights",
        "share of 1");
  FIELD(std::optional<double>, lost_lux,
        About("Irradiance that missed lights carry, mean over the samples", "lx").late());
  FIELD(double, overshade,
        "evaluated / needed over all samples; null where it cannot be compared: fewer than 100 lights are needed, or "
        "more than 0.001 of them are missed",
        "ratio");
  FIELD(std::optional<std::uint64_t>, reads,
        About("Elements of the light structure's buffers that shaders fetch at the samples to know their lights: "
              "headers, light indices, words of bits, nodes, runs, boxes. The lights themselves are not among them",
              "elements")
            .late());
  FIELD(std::optional<std::uint64_t>, read_bytes, About("Bytes of these elements", "B").late());
  FIELD(std::optional<WorstSampledFrame>, worst_frame, "The frame that misses most; absent where none is missed",
        Compares::follows);
  FIELD(std::optional<DarkestSample>, darkest, "The sample that loses most light; absent where none is lost",
        Compares::follows);
  FIELD(std::optional<double>, ground_m,
        About("Height of the horizontal plane (the world's y) on which these samples lie, since the scene has no "
              "triangles; absent where they lie on its surfaces",
              "m", "the whole run")
            .finite());
  FIELD(std::optional<std::vector<Waves>>, waves,
        "Lists among pixels that a GPU shades together; of visible surfaces at full resolution (divisor 1)", "",
        "the waves of all frames", Compares::follows);
  END_RECORD;
};

struct SampleSets {
  RECORD(SampleSets);
  FIELD(std::optional<SampleSet>, opaque, "");
  FIELD(std::optional<SampleSet>, transparent, "");
  FIELD(std::optional<SampleSet>, fog, "");
  FIELD(std::optional<SampleSet>, mirror, "");
  FIELD(std::optional<SampleSet>, anywhere, "");
  END_RECORD;
};

struct Decided {
  RECORD(Decided);
  FIELD(std::uint64_t, filter, "By double precision");
  FIELD(std::uint64_t, exact, "Decided or proven in exact arithmetic");
  END_RECORD;
};

struct DeepestMiss {
  RECORD(DeepestMiss);
  FIELD(std::uint64_t, frame, "Number of the frame on the camera's path, from 0", "frame", "one miss");
  FIELD(CellIndex, cell, "");
  FIELD(std::uint64_t, light, "Index in the lists", "light index", "one miss");
  FIELD(std::uint64_t, rig_light, "Its place among all lights of the scene", "light index", "one miss");
  FIELD(std::string, light_name, "In the scene");
  END_RECORD;
};

struct ListError {
  static About about() { return About("", Compares::cost); }
  RECORD(ListError);
  FIELD(std::uint64_t, true_pairs, "(cell, light) pairs that touch, decided exactly", "pairs", Compares::fixed);
  FIELD(std::uint64_t, reported_pairs, "In the method's lists", "pairs");
  FIELD(std::uint64_t, false_positives, "Pairs that are listed and not true", "pairs");
  FIELD(std::uint64_t, false_negatives, "True pairs that are not listed", "pairs");
  FIELD(double, excess_ratio, "false_positives / true_pairs", "share of 1");
  FIELD(double, miss_ratio, "false_negatives / true_pairs", "share of 1");
  FIELD(double, deepest_miss, "Largest 1 - d/r: the cell's distance from the light d, its range r. 0 without misses",
        "share of the light's range", "the misses");
  FIELD(std::uint64_t, undecided,
        "Pairs for which neither a common point nor a separation could be proven; counted as true", "pairs");
  FIELD(std::uint64_t, frames_checked, "Whose lists were held against the truth", "frames", Compares::fixed);
  FIELD(Decided, decided, "How the truth was found", "pairs", Compares::unjudged);
  FIELD(std::optional<DeepestMiss>, deepest, "The deepest miss; absent without misses", Compares::follows);
  END_RECORD;
};

struct DepthLengths {
  static constexpr const char* k_definition = "depth_lengths";
  RECORD(DepthLengths);
  FIELD(std::uint64_t, tiles, "With a visible pixel, summed over the frames", "tiles");
  FIELD(std::uint64_t, pixels, "In these tiles", "pixels");
  FIELD(Lengths, tiled, "One list per tile, from its nearest to its farthest surface");
  FIELD(Lengths, tiled_2_5d, "Of the 32 equal parts of that range, those that hold a surface (Harada 2012)");
  FIELD(Lengths, clusters, "The slice of the pixel's cell");
  FIELD(Lengths, explicit_clusters, "In the pixel's cell, from its nearest to its farthest surface");
  END_RECORD;
};

struct DepthRanges {
  RECORD(DepthRanges);
  FIELD(DepthLengths, slopes,
        "In tiles where 1 / depth (orthographic: depth) changes from each pixel to the next by at most a quarter of "
        "what it changes by in the tile");
  FIELD(DepthLengths, discontinuities, "In the other tiles");
  FIELD(std::uint64_t, outside, "Visible pixels beside the grid, in none of the tiles", "pixels");
  END_RECORD;
};

struct Lookup {
  RECORD(Lookup);
  FIELD(std::string, logarithm,
        About("How the lookup took its logarithm; glsl: at either end of what is allowed")
            .one_of({"rounded", "glsl", "fast"}));
  FIELD(std::string, depth, About("Where its depth came from").one_of({"given", "d32f", "d24"}));
  FIELD(std::uint64_t, samples, "Over all frames", "samples");
  FIELD(std::uint64_t, needed, "Lights that reach the samples", "lights");
  FIELD(std::uint64_t, missed, "Of those, not in what the lookup found", "lights");
  FIELD(std::uint64_t, wrong_samples, "Samples that miss a light", "samples");
  FIELD(std::uint64_t, safe_padding_ulps,
        "By so many ulps slices must reach over their boundaries to hold every depth that is looked up in them",
        "ulps");
  END_RECORD;
};

struct Unrepresentable {
  RECORD(Unrepresentable);
  FIELD(std::uint64_t, lights, "Most such lights in one frame", "lights", "all frames");
  FIELD(std::uint64_t, frames, "Frames with at least one such light", "frames", "all frames");
  END_RECORD;
};

struct ExtraPairs {
  RECORD(ExtraPairs);
  FIELD(double, mean, "Mean per frame", "pairs", "all frames");
  FIELD(double, ratio, "Extra pairs / pairs in float32", "ratio", "all frames");
  END_RECORD;
};

struct Precision {
  RECORD(Precision);
  FIELD(std::string, packing,
        About("How lights are packed before the assigner sees them").one_of({"float32", "half", "unorm16"}));
  FIELD(bool, inflate,
        "Each light is grown by what packing can have lost. Without it a packed case's assigner is not conservative, "
        "and misses do not fail the run");
  FIELD(std::string, label, "The packing's name, with +inflate if lights are inflated");
  FIELD(MeanMax, position_error_m, "Distance of the unpacked position from the scene's own", "m",
        "the lights of all frames");
  FIELD(MeanMax, range_error_m, "By how much ranges are too long: they are rounded up", "m",
        "the lights of all frames");
  FIELD(MeanMax, axis_error_rad, "Error of spots' axes; null where there is no spot", "rad", "the spots of all frames");
  FIELD(MeanMax, angle_error_rad, "Error of spots' half-angles; null where there is no spot", "rad",
        "the spots of all frames");
  FIELD(MeanMax, safe_inflation_m,
        "How far a packed volume can be from the exact one, from the unpacked numbers alone: bound of the place, and "
        "for spots the bounds of axis and angle times the range. Growing by it is enough",
        "m", "the lights of all frames");
  FIELD(Unrepresentable, unrepresentable,
        "Lights that the format cannot hold: without end; in half a coordinate or range beyond 65504 m. They stay in "
        "float32 here; an engine's conversion makes them infinite or cuts them off");
  FIELD(std::optional<ExtraPairs>, extra_pairs,
        "Pairs more than the same case in float32; null where there is no such case", Compares::cost);
  END_RECORD;
};

struct PreCullStep {
  RECORD(PreCullStep);
  FIELD(std::string, label, "The step");
  FIELD(MeanMax, removed, "Lights that it removes of those that the steps before it leave", "lights", "all frames");
  FIELD(std::optional<std::uint64_t>, frames,
        About("In which it removes lights; absent in older results", "frames", "all frames").late());
  END_RECORD;
};

struct LostAtSamples {
  RECORD(LostAtSamples);
  FIELD(std::uint64_t, needed, "Lights that reach the samples", "lights", "the samples of all frames");
  FIELD(std::uint64_t, lost, "Of those, removed", "lights", "the samples of all frames");
  END_RECORD;
};

struct OverLimit {
  RECORD(OverLimit);
  FIELD(std::vector<std::uint64_t>, lights, "Indices of those that it removes in some frame", "light index",
        "all frames");
  FIELD(std::uint64_t, lost_pairs, "True pairs of lights in frames where it removes them; they are among lost_pairs",
        "pairs", "all frames");
  END_RECORD;
};

struct PreCull {
  RECORD(PreCull);
  FIELD(std::string, label,
        "The steps in their order: frustum, distance(m), visible-set(view_cell_m,voxel_m,rays), most(lights,which are "
        "kept), most(lights,which are kept,type)");
  FIELD(bool, conservative,
        "In no frame can it remove a light that shares a point with a cell. Where it can, losses are counted and do "
        "not fail the run. frustum: in frustum and distance grids, whose cells end with the picture. distance: where "
        "no cell reaches farther. visible-set: never. most: where no frame has more lights");
  FIELD(MeanMax, kept, "Lights that the assigner gets", "lights", "all frames");
  FIELD(MeanMax, removed, "Lights that it does not get, the distant ones among them", "lights", "all frames");
  FIELD(MeanMax, distant, "Lights that a distance step puts into the list of distant lights", "lights", "all frames");
  FIELD(std::vector<PreCullStep>, steps, "In their order");
  FIELD(std::uint64_t, lost_pairs,
        "True pairs of lights that are removed; they are among error.false_negatives. 0 where nothing is held against "
        "the truth",
        "pairs", "all frames", Compares::cost);
  FIELD(ByName<LostAtSamples>, lost_at_samples, "By the set's name (volume: the random samples in the whole view)",
        Compares::cost);
  FIELD(std::uint64_t, view_cells, "View cells that have a visible set; 0 without such a step", "view cells",
        "the path");
  FIELD(std::uint64_t, bytes, "Of all view cells' sets: a bit per light, and voxels where lights move", "bytes",
        "the path", Compares::cost);
  FIELD(std::optional<double>, build_ns,
        About("What building the sets took, once and beside all other times; absent where nothing is timed", "ns",
              "one build", Compares::unjudged)
            .finite()
            .at_least(0));
  FIELD(std::optional<OverLimit>, over_limit, "What a limit (most) removes; absent without one");
  END_RECORD;
};

}  // namespace clusterbench::result
