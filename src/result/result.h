#pragma once
// A result: the output of `clusterbench run`.

#include "result/broken_case.h"
#include "result/case.h"

namespace clusterbench::result {

struct Tool {
  static constexpr const char* k_definition = "tool";
  RECORD(Tool);
  FIELD(std::string, version, "Version of clusterbench");
  FIELD(std::string, git_sha, "Commit that was built; with + where files differed from it");
  FIELD(std::string, compiler, "Name and version");
  FIELD(std::string, flags, "The compiler's flags");
  FIELD(std::string, build_type, "CMake's build type; only Release gives times worth comparing");
  FIELD(std::string, simd_target, "Instruction set that Highway chose");
  FIELD(ByName<std::string>, libraries, About("Version of each library").each("Its version"));
  END_RECORD;
};

struct Baseline {
  RECORD(Baseline);
  FIELD(Tool, tool, "As `tool` of this result's own program");
  FIELD(std::optional<bool>, is_same_program, "true: it is this program's own file, byte for byte; else absent");
  END_RECORD;
};

struct Clock {
  RECORD(Clock);
  FIELD(double, now, About("Mean when the run began", "", "all cores").finite().at_least(0).as_fraction());
  FIELD(std::optional<double>, max,
        About("The highest that the system allows; absent if it does not say", "", "the first core")
            .finite()
            .at_least(0)
            .as_fraction());
  END_RECORD;
};

struct Load {
  RECORD(Load);
  FIELD(double, begin, About("Just before the run").finite().at_least(0).as_fraction());
  FIELD(double, end, About("Just after; a run adds its own threads").finite().at_least(0).as_fraction());
  END_RECORD;
};

struct Machine {
  static constexpr const char* k_definition = "machine";
  RECORD(Machine);
  FIELD(std::string, cpu, "The processor's name");
  FIELD(std::optional<std::string>, family, "The vendor's number, on ARM the implementer's; absent if unknown");
  FIELD(std::optional<std::string>, model, "On ARM the part; absent if unknown");
  FIELD(std::optional<std::string>, stepping, "On ARM variant and revision, r3p1; absent if unknown");
  FIELD(std::optional<ByName<std::uint64_t>>, caches,
        About("Those that the first core uses; absent if unknown", "bytes", "the first core")
            .at_least(1)
            .each("By level: l1d, l1i, l2, l3"));
  FIELD(std::uint64_t, cores, "Logical ones", "cores", "the machine");
  FIELD(std::uint64_t, ram_bytes, "Main memory", "bytes", "the machine");
  FIELD(std::optional<Clock>, clock_mhz, "The processor's clock; absent if unknown, and where nothing is timed", "MHz");
  FIELD(std::optional<Load>, load, "Programs that run or wait to run. Absent where nothing is timed", "programs",
        "one minute, the machine");
  FIELD(std::string, os, "System, kernel and architecture");
  FIELD(std::optional<std::string>, host,
        "Of a result: start of the SHA-256 of the machine's name, by which `merge` keeps times of two machines of one "
        "kind apart. Absent where nothing is timed or counted in instructions, and where the machine does not tell "
        "its name");
  END_RECORD;
};

struct DeviceArithmetic {
  RECORD(DeviceArithmetic);
  FIELD(std::string, rounding,
        About("Of sums and products. either_way: to the next number on either side of the exact result")
            .one_of({"to_nearest", "either_way", "wrong"}));
  FIELD(bool, contracts, "A product and a sum were rounded once, though shaders forbid it");
  FIELD(bool, reorders, "A sum of three was not made in its order");
  FIELD(bool, flushes_denormals, "Results below the least normal number became 0, which is allowed");
  FIELD(double, division_ulp, "Largest error of a quotient; readings allow for 2.5", "ulp", "the numbers");
  FIELD(double, sqrt_ulp, "Largest error of a root; readings allow for 4.5", "ulp", "the numbers");
  FIELD(double, log2_ulp, "Largest error of a logarithm of numbers beyond [0.5, 2]; readings allow for 3", "ulp",
        "the numbers");
  FIELD(double, log2_error, "The same of numbers in [0.5, 2], absolute; readings allow for 4.8e-7", "octaves",
        "the numbers");
  END_RECORD;
};

struct MeasuredMachine {
  RECORD(MeasuredMachine);
  FIELD(std::string, name, "Of `machine` of its cases: machine 1, machine 2 ...");
  FIELD(Machine, machine, "As `machine` of a result");
  FIELD(std::string, simd_target, "As `tool.simd_target`");
  FIELD(std::optional<std::string>, host, "As `machine.host` of a result; absent where it is not known");
  END_RECORD;
};

struct ShardBaseline {
  RECORD(ShardBaseline);
  FIELD(std::string, file, "As the shard opened it: relative to the folder that it ran in");
  FIELD(std::string, sha256, "SHA-256 of the file: `merge` takes no other");
  END_RECORD;
};

struct Shard {
  RECORD(Shard);
  FIELD(std::uint64_t, index, About("Its number, from 1", "shards", "the run").at_least(1));
  FIELD(std::uint64_t, count, About("Of all shards of the run", "shards", "the run").at_least(1));
  FIELD(std::string, sweep,
        "SHA-256 of what all of its shards have in common: program, configuration, baseline, filter, scenes, "
        "cases");
  FIELD(std::optional<std::string>, filter, "That selected the run's cases (--filter); absent without one");
  FIELD(std::optional<std::string>, host, "Of earlier builds, which wrote it here: now `machine.host`");
  FIELD(std::uint64_t, cases, "Of this result, when it was written: `merge` counts them", "cases", "the result");
  FIELD(std::optional<ShardBaseline>, baseline,
        "The result that `merge` holds all cases against (--baseline, limits.baseline); absent without one");
  END_RECORD;
};

struct Device {
  RECORD(Device);
  FIELD(std::string, name, "Its name, from its driver");
  FIELD(std::string, driver, "Name and version");
  FIELD(std::string, vulkan, "Version of Vulkan");
  FIELD(std::string, uuid, "32 hexadecimal digits");
  FIELD(std::string, type,
        About("software: a driver that computes on the processor: its times are no GPU's, and nothing ranks by them")
            .one_of({"discrete GPU", "integrated GPU", "virtual GPU", "software", "other"}));
  FIELD(std::uint64_t, max_buffer_bytes, "Largest buffer that a shader can see", "bytes", "one buffer");
  FIELD(std::uint64_t, max_group_size, "Largest group of a shader", "invocations", "one group");
  FIELD(std::uint64_t, shared_bytes, "Shared memory", "bytes", "one group");
  FIELD(std::uint64_t, subgroup_size, "Invocations that run in step", "invocations", "one subgroup");
  FIELD(std::uint64_t, timestamp_bits, "Of its clock; 0: it has none", "bits", "the clock");
  FIELD(double, timestamp_period_ns, "Between two ticks of its clock", "ns", "the clock");
  FIELD(bool, rounds_to_nearest,
        "Whether shaders can ask for it. If not, methods count the error of each step twice, and pad lights by it");
  FIELD(std::optional<DeviceArithmetic>, arithmetic,
        About("What a probe found, before anything ran, by thousands of numbers whose results the processor knows. "
              "Methods do not run where it contradicts what their lists rest on. Absent in older results")
            .late());
  END_RECORD;
};

struct Plugin {
  RECORD(Plugin);
  FIELD(std::string, id, "First part of the names of its methods: ID.METHOD");
  FIELD(std::string, name, "For people");
  FIELD(std::string, version, "Its own");
  FIELD(std::string, file, "Its name, without its folder");
  FIELD(std::string, sha256, "Hash of the file: another one is another build");
  FIELD(std::string, interface_version, "That it was made for, as 1.0");
  END_RECORD;
};

struct SceneLights {
  RECORD(SceneLights);
  FIELD(std::uint64_t, point, "Point lights");
  FIELD(std::uint64_t, spot, "Spot lights");
  FIELD(std::uint64_t, directional, "Directional lights: they reach everything and are never assigned");
  FIELD(std::uint64_t, box, "Oriented boxes, from extras");
  FIELD(
      std::optional<std::uint64_t>, dark,
      About("Of the points and spots those that light nothing: of intensity 0, black, or of range 0, at the beginning, "
            "the middle and the end of the animations. Methods get them all the same. Absent in older results")
          .late());
  END_RECORD;
};

struct Ranges {
  RECORD(Ranges);
  FIELD(double, greatest, About("Longest").finite().at_least(0).as_fraction());
  FIELD(double, least, About("Shortest").finite().at_least(0).as_fraction());
  FIELD(double, median, About("Middle").finite().at_least(0).as_fraction());
  END_RECORD;
};

struct RangeRule {
  RECORD(RangeRule);
  FIELD(std::uint64_t, clamped, "Lights whose range was cut to max_range", "lights", "the scene");
  FIELD(double, cutoff_lux,
        About("A light without a range ends where its illuminance falls to this", "lux", "each light").as_fraction());
  FIELD(std::optional<std::uint64_t>, dark, "In older results: what is lights.dark now", "lights", "the scene");
  FIELD(std::uint64_t, from_intensity, "Lights without a range, which got one from their intensity", "lights",
        "the scene");
  FIELD(std::uint64_t, given, "Lights with a range in the file", "lights", "the scene");
  FIELD(double, max_range, About("Largest range that such a light gets", "m", "each light").as_fraction());
  FIELD(std::optional<Ranges>, ranges,
        "Ranges that were used, of all lights with an end. Absent where no light has one", "m", "the scene");
  END_RECORD;
};

struct Rig {
  RECORD(Rig);
  FIELD(std::uint64_t, lights, About("Number of lights", "lights", "the scene").at_least(1));
  FIELD(double, range, About("Range of each light", "m", "each light").finite().above(0).as_fraction());
  FIELD(std::uint64_t, seed, "Seed of the random numbers", "seed", "the scene");
  FIELD(Vector, size, About("Size of the box, [x, y, z]", "m", "the scene").finite().as_fraction());
  FIELD(double, spots,
        About("Share of spots", "share of 1", "the lights").finite().at_least(0).at_most(1).as_fraction());
  END_RECORD;
};

struct Scene {
  static About about() { return About("What the lights and paths came from"); }
  RECORD(Scene);
  FIELD(std::string, name, "Name in the names of cases: the file's, without its extension");
  FIELD(std::string, sha256,
        "Hash of the file and of all files that it refers to; of a scene made in memory, of its lights");
  FIELD(SceneLights, lights, "By type", "lights", "the scene");
  FIELD(std::optional<std::string>, light_digest,
        About("The same for the same assigned lights (kinds, positions, ranges, directions, angles, whether they are "
              "dark, along their animations, and how many directional ones), whatever their names, order and file are; "
              "absent in older results")
            .late());
  FIELD(std::uint64_t, frames, "Frames of all camera paths together", "frames", "the scene");
  FIELD(RangeRule, range_rule, "Where lights' ranges come from");
  FIELD(std::vector<std::string>, warnings, "What is unusual about the scene, as text");
  FIELD(std::optional<Rig>, rig, "Settings of a scene that was made in memory; absent for files");
  END_RECORD;
};

struct Front {
  RECORD(Front);
  FIELD(std::string, scene, "Name of one of scenes");
  FIELD(std::vector<std::string>, ids, "Ids of the cases with a star, in the order of cases");
  END_RECORD;
};

struct Conclusion {
  RECORD(Conclusion);
  FIELD(std::string, scene, "Name of one of scenes");
  FIELD(std::string, camera, "As in cases");
  FIELD(Size2, viewport, "[width, height]", "px", "the cases");
  FIELD(std::optional<std::string>, machine, "As the cases'; absent where times are of one machine");
  FIELD(Nullable<std::string>, take,
        "Id of the case to take; null: no case is sound, nothing that they are ranked by sees a light, or the run "
        "failed (text says what)");
  FIELD(Nullable<std::string>, against, "Id of the cheapest case that is known to cost more; null: there is none");
  FIELD(double, ratio, "Cost of that / cost of the case to take", "ratio", "the frame times");
  FIELD(Nullable<Pair>, ci95, "Its 95 % interval, of the times in it; null where times were not measured side by side",
        "ratio", "the frame times");
  FIELD(std::vector<std::string>, alike, "Ids of cases that are not known to cost more");
  FIELD(std::optional<Pair>, by_prices,
        "From and to what ratio goes as each price of config.cost (of uploading, drawing, reading, looping) takes "
        "values between half and twice its own; absent where nothing is modelled, and in older results",
        "ratio", "the samples");
  FIELD(std::string, text, "The same for people");
  END_RECORD;
};

struct Preset {
  RECORD(Preset);
  FIELD(std::string, name, "As a case's preset");
  FIELD(std::string, engine, "Whose scheme it is");
  FIELD(std::optional<std::string>, version,
        About("Of its code or publication: a release, a commit, a year; absent in older results").late());
  FIELD(std::optional<std::string>, evidence,
        About("ran: the engine's own code, or a transcription of it, was run and its lists compared. read: its code or "
              "publication was read. memory: neither. Absent in older results")
            .one_of({"ran", "read", "memory"})
            .late());
  FIELD(std::string, summary, "The scheme in a line");
  FIELD(std::string, source, "What was read");
  FIELD(std::string, approximated, "What is not as there; empty where nothing is known to differ");
  FIELD(std::string, unverified, "What stands on memory alone; empty where all was read");
  FIELD(std::optional<std::string>, assigns_on,
        About("Where the engine makes its lists: those of a GPU are not uploaded").one_of({"cpu", "gpu"}));
  FIELD(std::optional<std::uint64_t>, most_lights,
        About("That it takes in a frame; absent where no such limit is known", "count", "one frame").at_least(1));
  FIELD(std::optional<std::string>, mistakes,
        "That the engine has as it is shipped, which config.as_shipped models; absent where none is modelled");
  END_RECORD;
};

struct RankedLights {
  RECORD(RankedLights);
  FIELD(double, mean, "Mean");
  FIELD(double, max, "Of the frame with most");
  END_RECORD;
};

struct RankedPreset {
  RECORD(RankedPreset);
  FIELD(std::string, id, "Of the case");
  FIELD(std::string, preset, "Of the case");
  FIELD(std::optional<std::string>, standing,
        About("lists: samples lack at most a thousandth of the lights that they need. searched: likewise, and samples "
              "search the structure, whose price no GPU has measured. lacks_lights: samples lack more. unknown: no "
              "sample needs a light, or samples need fewer than 1000, too few to say so, and pairs are lost or were "
              "not compared with the truth. Absent in older results")
            .one_of({"lists", "searched", "lacks_lights", "unknown"}));
  FIELD(
      std::optional<Nullable<std::uint64_t>>, place,
      About(
          "Among the cases of the same standing, from 1; 1 + how many of them are known to cost less: by more than 5 "
          "%, and as each price of config.cost is half or twice what it is. null: not ranked. Absent in older results",
          "count", "the cases")
          .at_least(1));
  FIELD(double, gpu_ns,
        "upload_ns + traffic_ns + read_ns + shade_ns; null without samples. In older results the case's cost.gpu_ns",
        "ns", "one frame");
  FIELD(std::optional<double>, upload_ns,
        "Of the lists, by config.cost: 0 where the engine makes them on a GPU. Absent in older results", "ns",
        "one frame");
  FIELD(std::optional<double>, read_ns,
        "What samples read to know their lights, by config.cost. Absent in older results", "ns", "one frame");
  FIELD(std::optional<double>, shade_ns,
        "Lights that samples loop over, by config.cost; where the scene has no surfaces, each pixel shaded once at a "
        "random depth. Absent in older results",
        "ns", "one frame");
  FIELD(double, lights_per_sample, "Lights given at a sample of these sets, mean", "count", "all samples");
  FIELD(std::optional<double>, unlit,
        "Share of the lights that its samples need and lack: of the sets that cost something the one that lacks most, "
        "else on visible surfaces if they are asked for, else in the whole view; null where no sample needs a light. "
        "Absent in older results",
        "ratio", "the lights that samples need");
  FIELD(std::optional<Nullable<std::int64_t>>, missed_in_view,
        "Pairs that the lists lack, without those of lights beside the view; null where lists were not compared with "
        "the truth. Absent in older results",
        "pairs", "all frames");
  FIELD(std::string, why, "What speaks for and against it here, as text");
  END_RECORD;
};

struct PresetRanking {
  RECORD(PresetRanking);
  FIELD(std::string, scene, "Name of one of scenes");
  FIELD(std::string, camera, "As the cases'");
  FIELD(Size2, viewport, "As the cases': width, height", "pixels", "the cases");
  FIELD(std::optional<std::uint64_t>, frames,
        About("Of each case; absent in older results", "count", "each case").at_least(1));
  FIELD(Nullable<std::string>, best,
        "Id of the case with lists that costs the GPU least of those whose samples lack at most 0.1 % of the lights "
        "that they need; null where there is none");
  FIELD(std::optional<std::vector<std::string>>, alike,
        "Ids of best and of the cases that the model cannot tell from it; absent in older results");
  FIELD(std::vector<RankedPreset>, cases,
        "Best first: by standing, then by gpu_ns, or by the share of lights that samples lack");
  FIELD(std::optional<std::string>, text,
        "What to take, against what, by how much, and how sure that is, as text; absent in older results");
  FIELD(std::optional<RankedLights>, lights_in_view, "As the cases'; absent in older results", "lights", "the frames");
  END_RECORD;
};

struct Skipped {
  RECORD(Skipped);
  FIELD(std::string, name, "As of a case, as far as all of the skipped combinations share it");
  FIELD(std::string, reason, "Why, as text");
  FIELD(std::optional<std::string>, preset, "That it is of; absent for the configuration's own clusterings");
  END_RECORD;
};

// Parts of a configuration that readers of results use.
inline constexpr const char* k_config_shape = R"({
  "type": "object",
  "properties": {
    "allocation": {
      "description": "What `recommended` is made with; `clusterbench size` goes by it",
      "type": "object",
      "properties": {
        "margin": {
          "description": "What is allocated / the high-water mark",
          "x-unit": "ratio",
          "x-over": "all cases",
          "type": "number",
          "minimum": 1
        },
        "warn_at": {
          "description": "Share of the allocation above which to warn",
          "x-unit": "share of 1",
          "x-over": "all cases",
          "type": "number",
          "minimum": 0,
          "maximum": 1
        }
      },
      "required": [
        "margin",
        "warn_at"
      ]
    },
    "rank_by": {
      "description": "What rows, ranks and pareto_front go by; absent in older results: frame_time",
      "enum": [
        "frame_time",
        "frame_cost"
      ]
    }
  },
  "required": [
    "allocation"
  ]
})";

struct Result {
  static constexpr const char* k_definition = "result";
  RECORD(Result);
  FIELD(int, schema_version, About("Grows whenever a name or a meaning changes", "version", "the file").always(2));
  FIELD(std::string, name, "The configuration's name");
  FIELD(std::optional<std::string>, date,
        "When the run began: UTC, ISO 8601. Absent where nothing is timed, so that such results are the same whenever "
        "they are made");
  FIELD(std::optional<std::string>, command, "The command line. Absent where nothing is timed");
  FIELD(Tool, tool, "The program that measured");
  FIELD(std::optional<std::vector<Plugin>>, plugins,
        About("Shared libraries that cases' methods come from. Absent without any").items(1, 0));
  FIELD(std::optional<Shard>, shard,
        "The result is this part of a run (`run --shard`), and `clusterbench merge` makes one result of all parts. "
        "Absent: it is whole");
  FIELD(Machine, machine, "Where it was measured; with `machines` the kind of the first of them");
  FIELD(std::optional<std::vector<MeasuredMachine>>, machines,
        About("Of a merged result the machines whose times, device's times or instructions it has; those of two are "
              "never compared, and every one has ranks, fronts and conclusions of its own. Absent where it is one")
            .items(2, 0));
  FIELD(std::optional<Device>, device,
        "The device of the cases whose method runs on one (assigner.on_device). Absent where there are none");
  FIELD(Json, config,
        About("The configuration with every default (`clusterbench schema config`)").shaped(k_config_shape));
  FIELD(std::vector<Scene>, scenes, "");
  FIELD(std::vector<Case>, cases, "One method on one grid in one storage, along one camera's path");
  FIELD(std::vector<Front>, pareto_front,
        "Per scene the cases on the Pareto front: no other one of the same camera and viewport is as good in frame "
        "time (beyond the interval of their ratio), bytes and overshade together, and better in one; where "
        "config.rank_by is frame_cost, in cost and bytes. What draws lights has no lists, so its bytes count as "
        "unknown. Only cases that are eligible, and none that samples search");
  FIELD(std::vector<Skipped>, skipped, "Combinations that cannot be");
  FIELD(std::optional<std::vector<BrokenCase>>, broken,
        About("Cases of plug-ins that were not measured to the end: the plug-in crashed, hung, took too much memory or "
              "failed. Each fails the run. Absent where there are none")
            .items(1, 0));
  FIELD(std::optional<std::vector<Preset>>, presets,
        "What is known of the presets that cases are of, as `clusterbench list presets` tells it; absent without any");
  FIELD(std::optional<std::vector<PresetRanking>>, preset_rankings,
        "Per scene, camera and viewport the cases of presets beside each other; absent without any");
  FIELD(std::optional<std::vector<Conclusion>>, conclusions,
        "Per scene, camera and viewport what to take by this result, and how sure that is. Of the cases that lose "
        "nothing that their samples see, that which costs least: frame time and, where samples were asked for, upload, "
        "reading and shading by the model of config.cost. Of those that the times cannot tell apart, or the model "
        "(within 5 %), one whose samples lack nothing comes before others, then one on the front, then the one with "
        "the fewest bytes. Presets are ranked by themselves. Absent in older results");
  FIELD(std::optional<std::vector<std::string>>, failed,
        "What the run failed for beside the failures of its cases, a line each: budgets (limits.fail_if), lights that "
        "are missing, what a baseline has, a program beside it. conclusions then take nothing. Absent where it failed "
        "for none of these");
  FIELD(std::optional<Baseline>, baseline, "The other program of run --baseline-binary");
  END_RECORD;
};

// The schema of any result: `clusterbench schema result`, fields in their order.
Json result_schema();

extern template const Type& type_of<Tool>();
extern template const Type& type_of<Machine>();
extern template const Type& type_of<Scene>();
extern template const Type& type_of<Case>();
extern template const Type& type_of<Result>();

}  // namespace clusterbench::result
