#pragma once
// Times and instructions.

#include "result/shared_parts.h"

namespace clusterbench::result {

struct WarmTimes {
  RECORD(WarmTimes);
  FIELD(Time, frame_ns, "Per frame: pre_cull_ns, assign_ns and convert_ns");
  FIELD(Time, assign_ns, "Per frame: as the one beside cold times");
  FIELD(std::optional<Time>, convert_ns, "Per frame: as the one beside cold times");
  FIELD(std::optional<Time>, pre_cull_ns, "Per frame: as the one beside cold times");
  END_RECORD;
};

struct PassesPerSample {
  RECORD(PassesPerSample);
  FIELD(std::uint64_t, assign, About("Of assign_ns").at_least(1));
  FIELD(std::optional<std::uint64_t>, convert,
        About("Of convert_ns; absent where a method leaves its own structure").at_least(1));
  END_RECORD;
};

struct Disturbed {
  RECORD(Disturbed);
  FIELD(double, others_cores,
        About("Processors that other programs of the machine kept busy meanwhile, in the mean", "processors")
            .at_least(0));
  FIELD(double, stolen_cores,
        About("Processors that other guests of the host took meanwhile, in the mean", "processors").at_least(0));
  FIELD(std::uint64_t, throttled,
        "Times that processors slowed down because of heat; 0 where Linux does not count them", "times");
  END_RECORD;
};

struct WorstTimedFrame {
  RECORD(WorstTimedFrame);
  FIELD(std::uint64_t, frame, "Number of the frame on the camera's path, from 0", "frame", "the path");
  FIELD(double, ns,
        "Time of this frame: its share of a pass over the timed frames, by the frames' medians over the rounds, of "
        "frame_ns",
        "ns", "the rounds");
  FIELD(Interval, ci95, "95 % interval of ns", "ns", "the rounds");
  FIELD(std::optional<std::uint64_t>, pairs, "Pairs (cell, light) of this frame; absent without cells", "pairs",
        "one frame");
  END_RECORD;
};

struct TimedPairs {
  RECORD(TimedPairs);
  FIELD(double, mean, "Mean per frame");
  FIELD(std::uint64_t, max, "Largest of a frame");
  END_RECORD;
};

struct DeviceRepeats {
  static constexpr const char* k_definition = "device_repeats";
  RECORD(DeviceRepeats);
  FIELD(std::uint64_t, upload, About("Of upload_ns").at_least(1));
  FIELD(std::uint64_t, run, About("Of run_ns").at_least(1));
  FIELD(std::uint64_t, floor, About("Of floor_ns").at_least(1));
  END_RECORD;
};

struct WarmDeviceTimes {
  RECORD(WarmDeviceTimes);
  FIELD(Time, run_ns, "Per frame: as the one beside cold times");
  FIELD(Time, upload_ns, "Per frame: as the one beside cold times");
  FIELD(Time, floor_ns, "Per frame: as the one beside cold times");
  FIELD(double, floor_ratio, "As the one beside cold times", "ratio", "the rounds");
  FIELD(DeviceRepeats, repeats, "As the ones beside cold times", "repetitions", "one sample of a frame");
  END_RECORD;
};

struct DeviceClock {
  RECORD(DeviceClock);
  FIELD(double, median, "Over the rounds");
  FIELD(double, min, "In the slowest round");
  FIELD(double, max, "In the fastest round");
  FIELD(std::vector<double>, samples, "Of each round, launch after launch");
  END_RECORD;
};

struct ShaderStatistic {
  RECORD(ShaderStatistic);
  FIELD(std::string, shader, "Of src/gpu/shaders, with its mode if it has one");
  FIELD(std::string, name, "As the driver calls it");
  FIELD(double, value, About("As the driver tells it", "the driver's", "one shader").finite());
  END_RECORD;
};

// Of a method that runs on a device, by the device's clock.
struct DeviceTimes {
  RECORD(DeviceTimes);
  FIELD(std::string, device, "Name and driver of the device; times of one device alone compare");
  FIELD(std::optional<bool>, software,
        About("true: the device computes on the processor: its times are no GPU's, and nothing ranks by them. Absent "
              "in older results, where device.type says it")
            .late());
  FIELD(std::uint64_t, frames_timed, "Evenly spaced over the path; all times are means over them", "frames",
        "the path");
  FIELD(std::optional<std::string>, caches,
        About("Of all times here but those of warm. cold: memory of the device is filled before each frame's upload, "
              "as all else of an engine's frame does; warm: the same frame again and again. Absent in older results, "
              "where caches were as the method before left them")
            .one_of({"cold", "warm"})
            .late());
  FIELD(std::optional<std::uint64_t>, launches,
        About("How often the device was opened anew, each time for an equal share of every array of samples, one after "
              "the other, in one process. From two on all 95 % intervals are between them, else between rounds",
              "openings", "the case")
            .at_least(1)
            .late());
  FIELD(Time, run_ns, "Per frame: the device's work, from the lights to the lists");
  FIELD(Time, upload_ns, "Per frame: bringing the frame's lights to the device");
  FIELD(Time, readback_ns, "Per frame: bringing the lists back, which a renderer does not do");
  FIELD(double, dispatches, "Steps of this work that wait for each other, per frame", "steps", "the timed frames");
  FIELD(Time, floor_ns,
        "Per frame: as many steps that do nothing, of which the last writes as many bytes as the result has");
  FIELD(double, floor_ratio, "run_ns by floor_ns: how far the work is from only starting and writing", "ratio",
        "the rounds");
  FIELD(std::optional<DeviceRepeats>, repeats,
        About("How often a frame's work is repeated in one sample, which is the mean: until it lasts 1,000 periods of "
              "the clock and 20 us, if that fits in a submission of 100 ms; in the frame with fewest. Of cold times "
              "each has a span of its own. Readbacks are never repeated",
              "repetitions", "one sample of a frame")
            .late());
  FIELD(std::optional<WarmDeviceTimes>, warm, "The same frames with warm caches, beside cold times");
  FIELD(std::optional<Time>, build_ns,
        "Per build: the device's work for a changed grid; in no other time. Absent where the host makes the cells");
  FIELD(std::optional<double>, builds_per_frame,
        About("As in timing, of build_ns", "builds", "the timed frames").finite().at_least(0).as_fraction());
  FIELD(std::optional<DeviceClock>, clock_mhz,
        "How fast the device ran, by a shader that counts cycles after each round of the method. Absent where its "
        "shaders cannot count. Some devices count at a fixed rate",
        "MHz", "the rounds");
  FIELD(
      std::optional<std::vector<ShaderStatistic>>, shaders,
      About("Registers, spills and memory of the method's shaders. Absent where the driver tells nothing").items(1, 0));
  END_RECORD;
};

struct ShadowCullTimes {
  static About about() { return About("", "ns"); }
  RECORD(ShadowCullTimes);
  FIELD(std::uint64_t, resolution, About("As in shadows.culls", "texels", "the case").at_least(1));
  FIELD(std::string, texels, About("As in shadows.culls").one_of({"proven", "sampled"}));
  FIELD(double, bias_m, About("As in shadows.culls", "m", "the case").finite());
  FIELD(double, near_m, About("As in shadows.culls", "m", "the case").finite());
  FIELD(double, cast_ns,
        About("Making the finest level of a map by ray casting, mean; a renderer has its shadow map already", "",
              "maps of all methods")
            .finite());
  FIELD(double, reduce_ns, About("Making the coarser levels of a map, mean", "", "maps of all methods").finite());
  FIELD(MeanMax, step_ns, "Taking pairs out of a frame's lists, on one thread", "", "frames");
  END_RECORD;
};

struct BaselineLaunch {
  RECORD(BaselineLaunch);
  FIELD(std::vector<double>, base_ns,
        About("Times of the other program", "ns", "the rounds of a launch").finite().items(1, 0).as_fraction());
  FIELD(std::vector<double>, new_ns,
        About("Times of this program", "ns", "the rounds of a launch").finite().items(1, 0).as_fraction());
  END_RECORD;
};

struct ListsDiffer {
  RECORD(ListsDiffer);
  FIELD(std::uint64_t, frames, About("Number of frames whose lists differ", "frames", "all frames").at_least(1));
  FIELD(std::uint64_t, frame, "First frame whose lists differ", "frame", "the path");
  FIELD(CellIndex, cell, "First cell whose list differs");
  FIELD(std::uint64_t, light, "First light that only one of the two lists has", "light index", "one cell");
  FIELD(std::string, in, About("Whose list has the light").one_of({"base", "new"}));
  FIELD(std::uint64_t, base_pairs, "Pairs of the other program", "pairs", "all frames");
  FIELD(std::uint64_t, new_pairs, "Pairs of this program", "pairs", "all frames");
  END_RECORD;
};

struct BaselineTimes {
  RECORD(BaselineTimes);
  FIELD(std::vector<BaselineLaunch>, launches,
        "One for each start of both programs; times in the order of their rounds");
  FIELD(double, base_ns, "Median of the other program's times", "ns", "the rounds of all launches");
  FIELD(double, new_ns, "Median of this program's times", "ns", "the rounds of all launches");
  FIELD(double, ratio,
        "New / base: exp of the trimmed mean over launches of ln(lower quartile of new_ns / lower quartile of base_ns)",
        "ratio", "the launches");
  FIELD(Interval, ci95, "95 % interval of the ratio", "ratio", "the launches");
  FIELD(std::optional<ListsDiffer>, lists_differ, "Where both programs' lists first differ");
  END_RECORD;
};

struct AgainstFirst {
  RECORD(AgainstFirst);
  FIELD(std::string, assigner, "Label of the first assigner");
  FIELD(
      double, ratio,
      "This case's frame time by that of the group's first assigner in the same storage: median of the rounds' ratios",
      "ratio", "the rounds");
  FIELD(Interval, ci95, "95 % interval of the ratio", "ratio", "the rounds");
  END_RECORD;
};

struct FitTimes {
  RECORD(FitTimes);
  FIELD(Time, follow_ns,
        "Finding what a frame needs, and making its grid; in no other time. Building a method for the grid is in "
        "assign_ns",
        "ns", "the rounds");
  FIELD(Time, unfitted_ns, "frame_ns of the same case in the grid that does not follow", "ns", "the rounds");
  FIELD(double, ratio, "frame_ns by unfitted_ns: median of the rounds' ratios", "ratio", "the rounds");
  FIELD(Interval, ci95, "95 % interval of the ratio", "ratio", "the rounds");
  END_RECORD;
};

struct Timing {
  RECORD(Timing);
  FIELD(std::uint64_t, frames_timed,
        "Evenly spaced over the path; all times but that of worst_frame are means over them", "frames", "the path");
  FIELD(
      std::optional<std::string>, caches,
      About("Of frame_ns, assign_ns, convert_ns, worst_frame and against_first. cold: swept before each frame, as all "
            "else of an engine's frame does; warm: the same frames again and again. Absent in older results: warm")
          .one_of({"cold", "warm"})
          .late());
  FIELD(std::optional<std::string>, session,
        About("Equal in cases that the same launches have measured; only their times have ratios").late());
  FIELD(std::optional<std::uint64_t>, launches,
        About("Processes that measured, each an equal share of every array of samples, one after the other. From two "
              "on all 95 % intervals are between launches (Student's t on the logarithms of the launches' medians), "
              "else they are bootstrap intervals over the rounds of one process",
              "processes", "the case")
            .at_least(1)
            .late());
  FIELD(Time, frame_ns,
        "Per frame: what a frame takes, pre_cull_ns, assign_ns and convert_ns of the same round together");
  FIELD(std::optional<WorstTimedFrame>, worst_frame,
        About("The slowest of the timed frames and of the path's frame with the most pairs, which is timed beside them")
            .late());
  FIELD(std::optional<TimedPairs>, pairs,
        "(cell, light) pairs of the timed frames, which frame_ns goes with; absent without cells", "pairs",
        "the timed frames");
  FIELD(std::optional<double>, builds_per_frame,
        About("0: the grid stays from frame to frame; 1: each frame has its own, as with fit slices or a projection "
              "that moves",
              "builds", "the timed frames")
            .finite()
            .at_least(0)
            .late()
            .as_fraction());
  FIELD(Time, build_ns, "Per build: preparing for a grid, once for each projection");
  FIELD(Time, assign_ns, "Per frame: assignment, mean over the timed frames, with the builds of builds_per_frame");
  FIELD(std::optional<Time>, convert_ns,
        "Per frame: from lists to the layout of the storage; absent where a method leaves its own structure");
  FIELD(std::optional<WarmTimes>, warm,
        "The same frames with warm caches, beside cold times; samples need not be as many");
  FIELD(std::optional<PassesPerSample>, passes_per_sample,
        About("How many passes over the timed frames one sample of warm times is the mean of, in the launch with "
              "fewest; each launch runs as many as take timing.min_time_ms. A sample of cold times is one pass",
              "passes", "one sample")
            .late());
  FIELD(std::optional<Time>, pre_cull_ns,
        "Per frame: from all lights to those that the method gets, side by side; absent where nothing is culled. "
        "Visible sets are built before (pre_cull.build_ns)");
  FIELD(std::optional<std::vector<ShadowCullTimes>>, shadow_cull,
        About("Of the ways of shadows.culls, in their order; in no other time. Wall time in the process of the run, "
              "where the lists are checked")
            .items(1, 0));
  FIELD(double, ns_per_pair, "frame_ns.median / pairs.mean; null without pairs in lists", "ns", "the timed frames");
  FIELD(double, write_floor_ns,
        "Per frame: time to copy its finished lists once as the standard `packed` holds them, headers and indices, "
        "from buffers of the frame into others of the frame",
        "ns", "the rounds");
  FIELD(double, floor_ratio,
        "assign_ns by write_floor_ns, both with warm caches: how far the assignment is from only writing its result",
        "ratio", "the rounds");
  FIELD(
      std::optional<AgainstFirst>, against_first,
      "How much longer than the group's first assigner; absent of that one. A group: scene, camera, viewport and grid");
  FIELD(std::optional<Disturbed>, disturbed,
        About("What else went on while the cases of this grid, camera and viewport were measured, over all launches",
              "", "the measuring of the group")
            .late());
  FIELD(std::optional<FitTimes>, fit, "Of slices that follow what frames need");
  FIELD(std::optional<BaselineTimes>, baseline, "Rounds beside another program (run --baseline-binary)");
  END_RECORD;
};

struct Count {
  RECORD(Count);
  FIELD(std::string, source,
        About("Hardware counters or valgrind's callgrind; compare counts of one source only")
            .one_of({"perf", "callgrind"}));
  FIELD(std::string, simd_target, "Instruction set of the counted code; callgrind offers fewer than the machine has");
  FIELD(std::uint64_t, frames,
        About("Frames that are counted: those that are timed", "frames", "the path").at_least(1));
  FIELD(std::uint64_t, instructions_per_build,
        "Preparation for a grid; as it may take memory, some tens of instructions depend on the heap", "instructions",
        "one build");
  FIELD(PerFrame, instructions_per_frame, "Instructions of one frame", "instructions");
  FIELD(std::optional<PerFrame>, cycles_per_frame, "Cycles of one frame; absent where only instructions are counted",
        "cycles");
  END_RECORD;
};

}  // namespace clusterbench::result
