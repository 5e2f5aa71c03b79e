// Presets beside each other: by what carries over to the engines, and by what samples see.

#include "report/presets/preset_ranking.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "config/presets/preset_library.h"
#include "records.h"
#include "report/presets/preset_losses.h"
#include "report/presets/preset_words.h"
#include "run/grid_facts.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

// A case of a preset whose parts of the cost are these, in ns.
Json preset_case(const std::string& preset, double upload_ns, double read_ns, double shade_ns) {
  return {{"id", "id-" + preset},
          {"preset", preset},
          {"scene", "level"},
          {"camera", "walk"},
          {"viewport", {1920, 1080}},
          {"frames", 30},
          {"warnings", Json::array()},
          {"lights_in_view", {{"mean", 120.5}, {"max", 300}}},
          {"assigner", {{"name", "aabb"}}},
          {"storage", "packed"},
          {"samples",
           {{"opaque",
             {{"samples", 1000},
              {"evaluated", 12000},
              {"needed", 8000},
              {"missed", 0},
              {"missed_outside", 0},
              {"unlit", 0.0},
              {"read_bytes", 56000}}}}},
          {"buffers",
           {{"upload_bytes", {{"mean", 16000}}},
            {"bytes", {{"high_water", 16000}}},
            {"overflow", {{"dropped_pairs", 0}, {"lights", Json::array()}, {"frames", 0}}}}},
          {"cost",
           {{"upload_ns", upload_ns},
            {"read_ns", read_ns},
            {"shade_ns", shade_ns},
            {"sets", {{"opaque", {{"samples", 2e6}}}}}}},
          {"timing", {{"assign_ns", {{"median", 50000.0}}}}}};
}

Json searched(Json result_case) {
  result_case["samples_search"] = true;
  result_case["storage"] = "own";
  result_case["assigner"]["name"] = "bvh";
  return result_case;
}

Json lacking(Json result_case, std::uint64_t missed) {
  Json& opaque = result_case["samples"]["opaque"];
  opaque["missed"] = missed;
  opaque["unlit"] = static_cast<double>(missed) / opaque["needed"].get<double>();
  return result_case;
}

Json ranking_of_cases(const Json& cases, const Json& config = {{"cost", Json::object()}}) {
  result::Scene scene;
  scene.name = "level";
  result::Result origin;
  origin.config = config;
  return result::to_json(preset_rankings({scene}, test::cases_of(cases), origin).at(0));
}

std::string preset_table_of(const Json& ranking, const Json& cases) {
  return preset_table(test::result_of({{"preset_rankings", Json::array({ranking})}, {"cases", cases}}));
}

std::vector<std::string> order(const Json& ranking) {
  std::vector<std::string> names;
  for (const Json& line : ranking["cases"]) names.push_back(line["preset"].get<std::string>());
  return names;
}

const Json& line_of(const Json& ranking, const std::string& preset) {
  return *std::ranges::find_if(ranking["cases"], [&](const Json& line) { return line["preset"] == preset; });
}

using Names = std::vector<std::string>;

TEST(PresetRanking, where_nothing_is_seen_no_preset_has_a_place_and_none_is_taken) {
  Json beside = preset_case("three-js", 0, 1e4, 2e5), behind = preset_case("godot", 0, 1e4, 3e5);
  for (Json* one : {&beside, &behind}) (*one)["lights_in_view"] = {{"mean", 0}, {"max", 0}};
  Json black = preset_case("three-js", 0, 1e4, 2e5), off = preset_case("godot", 0, 1e4, 3e5);
  for (Json* one : {&black, &off}) (*one)["lights_seen"] = 0;
  const Json away = ranking_of_cases({beside, behind}), dark = ranking_of_cases({black, off});
  for (const auto& [ranking, why] :
       {std::pair(&away, "no light is in view in any frame"),
        std::pair(&dark, "all lights in view are dark (intensity 0 or black) in all frames")}) {
    EXPECT_TRUE((*ranking)["best"].is_null());
    EXPECT_EQ((*ranking)["text"], std::string("which preset suits is not known: ") + why);
    for (const Json& line : (*ranking)["cases"]) {
      EXPECT_EQ(line["standing"], "unknown");
      EXPECT_TRUE(line["place"].is_null());
      EXPECT_TRUE(line["why"].get<std::string>().starts_with(std::string(why) + ", so not ranked: ")) << line["why"];
    }
  }
}

TEST(PresetRanking, without_samples_losses_are_those_of_pairs_and_it_says_so) {
  Json none = preset_case("filament", 1e3, 1e4, 1e5);
  none.erase("samples");
  none.erase("cost");
  none["error"] = {{"false_negatives", 5}, {"true_pairs", 1000}};
  const Json ranking = ranking_of_cases(Json::array({none}));
  const std::string text = ranking["text"], why = line_of(ranking, "filament")["why"];
  EXPECT_EQ(
      text,
      "which preset suits is not known: no sample was taken, so losses are counted in pairs of a cell and a light, "
      "and not in what is seen; --set shading.samples=1024 takes samples");
  EXPECT_TRUE(
      why.starts_with("no sample was taken, so what it loses is counted in pairs of a cell and a light, and "
                      "not in what is seen: its test misses cells that the light reaches: 5 pairs of 1000"))
      << why;
}

TEST(PresetRanking, lists_that_a_gpu_makes_are_not_uploaded) {
  const Json ranking =
      ranking_of_cases({preset_case("three-js", 9e6, 1e4, 2e5), preset_case("filament", 1e3, 1e4, 4e5)});
  EXPECT_EQ(order(ranking), (Names{"three-js", "filament"}));
  EXPECT_EQ(line_of(ranking, "three-js")["upload_ns"], 0.0);
  EXPECT_EQ(line_of(ranking, "three-js")["gpu_ns"], 2.1e5);
  EXPECT_EQ(line_of(ranking, "filament")["upload_ns"], 1e3);
  const std::string why = line_of(ranking, "three-js")["why"];
  EXPECT_NE(why.find("nothing to upload: the GPU makes its lists, which is not in its cost"), std::string::npos) << why;
}

TEST(PresetRanking, a_time_on_the_cpu_is_shown_only_of_engines_that_assign_there) {
  const Json cases{preset_case("three-js", 0, 1e4, 2e5), preset_case("filament", 1e3, 1e4, 4e5)};
  const result::Result result =
      test::result_of({{"preset_rankings", Json::array({ranking_of_cases(cases)})}, {"cases", cases}});
  const std::string table = preset_table(result);
  const auto line = [&](const std::string& preset) {
    const std::size_t at = table.find(" " + preset + " ");
    return table.substr(at, table.find('\n', at) - at);
  };
  EXPECT_TRUE(line("three-js").ends_with("gpu")) << table;
  EXPECT_TRUE(line("filament").ends_with("50.0")) << table;
  EXPECT_NE(table.find("of engines that assign on the CPU"), std::string::npos) << table;
  EXPECT_NE(table.find("--device NAME (clusterbench list devices) runs and times shaders that work as the engines' do, "
                       "as far as `list presets` says: "
                       "three-js.\n"),
            std::string::npos)
      << table;
  EXPECT_NE(table.find("30 frames; lights in view: 120 on average, 300 at most"), std::string::npos) << table;
  EXPECT_EQ(preset_conclusions(result),
            "conclusion: presets for level/walk: " + ranking_of_cases(cases)["text"].get<std::string>() + ".\n");
}

TEST(PresetRanking, a_case_on_a_device_says_so_and_needs_no_hint) {
  Json on_device = preset_case("three-js", 0, 1e4, 2e5);
  on_device["assigner"]["on_device"] = true;
  on_device.erase("timing");
  const Json cases{on_device, preset_case("filament", 1e3, 1e4, 4e5)};
  const Json ranking = ranking_of_cases(cases);
  EXPECT_EQ(line_of(ranking, "three-js")["upload_ns"], 0.0);
  const std::string table = preset_table_of(ranking, cases);
  const std::size_t at = table.find(" three-js ");
  EXPECT_TRUE(table.substr(at, table.find('\n', at) - at).ends_with("device")) << table;
  EXPECT_EQ(table.find("--device NAME"), std::string::npos) << table;
  const auto told = [&](bool is_on_device) {
    on_device["assigner"]["on_device"] = is_on_device;
    return preset_facts(test::cases_of(Json::array({on_device})), {}).at(0).approximated;
  };
  EXPECT_EQ(told(false), config::find_preset("three-js")->approximated);
  EXPECT_EQ(told(true), told(false) + "; on the device: " + config::find_preset("three-js")->on_device->approximated);
}

// A storage drops after its lists were compared, a shader before.
TEST(PresetRanking, what_has_no_room_in_a_list_of_the_methods_own_is_dropped_and_not_missed_by_its_test) {
  Json full = preset_case("three-js", 0, 1e4, 2e5);
  full["buffers"]["overflow"] = {{"dropped_pairs", 12}, {"lights", {3, 4}}, {"frames", 2}};
  full["error"] = {{"false_negatives", 9}, {"true_pairs", 1000}};
  EXPECT_EQ(preset_losses(test::cases_of(Json::array({full}))[0]).by_method, 9u) << "in a storage";
  full["storage"] = "own";
  const PresetLosses own = preset_losses(test::cases_of(Json::array({full}))[0]);
  EXPECT_EQ(own.by_method, 0u);
  EXPECT_EQ(own.dropped, 12u);
  full["buffers"]["overflow"]["dropped_pairs"] = 4;
  EXPECT_EQ(preset_losses(test::cases_of(Json::array({full}))[0]).by_method, 5u);
}

TEST(PresetRanking, lost_pairs_that_no_sample_needs_are_told_and_are_no_loss) {
  Json drops = preset_case("filament", 1e3, 1e4, 1e5);
  drops["buffers"]["overflow"] = {{"dropped_pairs", 12}, {"lights", {3, 4}}, {"frames", 2}};
  drops["error"] = {{"false_negatives", 5}, {"true_pairs", 1000}};
  const Json ranking = ranking_of_cases({preset_case("bevy", 1e3, 1e4, 4e5), drops});
  EXPECT_EQ(order(ranking), (Names{"filament", "bevy"}));
  EXPECT_EQ(ranking["best"], "id-filament");
  const std::string why = line_of(ranking, "filament")["why"];
  EXPECT_NE(why.find(" need: drops 2 lights"), std::string::npos) << why;
  EXPECT_NE(why.find("its test misses cells that the light reaches: 5 pairs of 1000"), std::string::npos) << why;
}

TEST(PresetRanking, what_samples_lack_decides_by_one_threshold_whatever_the_cause) {
  const Json cheap = preset_case("filament", 1e3, 1e4, 1e5), dear = preset_case("bevy", 1e3, 1e4, 4e5);
  EXPECT_EQ(order(ranking_of_cases({lacking(cheap, 8), dear})), (Names{"filament", "bevy"})) << "a thousandth";
  const Json ranking = ranking_of_cases({lacking(cheap, 9), dear, lacking(preset_case("unreal", 0, 1, 1), 800)});
  EXPECT_EQ(order(ranking), (Names{"bevy", "filament", "unreal"})) << "by how much they lack, not by cost";
  EXPECT_EQ(line_of(ranking, "filament")["standing"], "lacks_lights");
  const std::string all = ranking_of_cases(Json::array({lacking(cheap, 9)}))["text"];
  EXPECT_NE(all.find("no preset that was measured is known to give samples all lights"), std::string::npos) << all;
}

// Samples that need so few lights, and lack none of them.
Json with_few_samples(Json result_case, std::uint64_t needed) {
  result_case["samples"]["opaque"]["needed"] = needed;
  if (!result_case.contains("error")) result_case["error"] = {{"false_negatives", 0}, {"true_pairs", 3000}};
  return result_case;
}

Json over_a_limit(Json result_case) {
  result_case["warnings"] = Json::array({{{"kind", "too_many_lights"}, {"text", "takes 255 lights"}}});
  result_case["error"] = {{"false_negatives", 450}, {"true_pairs", 3000}};
  result_case["pre_cull"] = {{"lost_pairs", 450}, {"over_limit", {{"lights", {3, 4}}, {"lost_pairs", 450}}}};
  return result_case;
}

TEST(PresetRanking, lights_lost_to_a_limit_are_no_small_loss_where_few_are_needed) {
  const Json limited = over_a_limit(preset_case("playcanvas", 0, 1e4, 1e5)), whole = preset_case("bevy", 1e3, 1e4, 4e5);
  for (const std::uint64_t needed : {1, 2, 999}) {
    const Json ranking = ranking_of_cases({with_few_samples(limited, needed), with_few_samples(whole, needed)});
    EXPECT_EQ(order(ranking), (Names{"bevy", "playcanvas"})) << needed;
    EXPECT_EQ(ranking["best"], "id-bevy") << needed;
    EXPECT_EQ(line_of(ranking, "playcanvas")["standing"], "unknown") << needed;
  }
  const Json ranking = ranking_of_cases({with_few_samples(limited, 1), with_few_samples(whole, 1)});
  const std::string why = line_of(ranking, "playcanvas")["why"], text = ranking["text"];
  EXPECT_EQ(why.find("loses nothing"), std::string::npos) << why;
  EXPECT_NE(why.find("its samples need only 1 light, summed over all samples, too few to tell whether what it loses is "
                     "seen: takes 255 lights"),
            std::string::npos)
      << why;
  EXPECT_NE(text.find("samples need only 1 light"), std::string::npos) << text;
  EXPECT_NE(text.find("not ranked: playcanvas"), std::string::npos) << text;
  const Json cases{with_few_samples(limited, 1), with_few_samples(whole, 1)};
  const std::string table = preset_table_of(ranking, cases);
  EXPECT_NE(table.find(" 450      -"), std::string::npos) << table << "a share of one light is none";
  const Json enough = ranking_of_cases({with_few_samples(limited, 1000), with_few_samples(whole, 1000)});
  EXPECT_EQ(enough["best"], "id-playcanvas") << "of a thousand that samples need none is lost";
}

TEST(PresetRanking, lists_that_drop_miss_or_are_not_compared_are_unknown_where_few_lights_are_needed) {
  Json drops = preset_case("filament", 1e3, 1e4, 1e5), misses = preset_case("unreal", 0, 1e4, 1e5);
  drops["buffers"]["overflow"] = {{"dropped_pairs", 12}, {"lights", {3, 4}}, {"frames", 2}};
  misses["error"] = {{"false_negatives", 1}, {"true_pairs", 3000}};
  Json unchecked = with_few_samples(preset_case("three-js", 0, 1e4, 1e5), 40);
  unchecked.erase("error");
  const Json ranking = ranking_of_cases({with_few_samples(drops, 40), with_few_samples(misses, 40), unchecked});
  for (const Json& line : ranking["cases"]) EXPECT_EQ(line["standing"], "unknown") << line;
  EXPECT_EQ(ranking["best"], Json());
  const std::string text = ranking["text"];
  EXPECT_TRUE(text.starts_with("which preset suits is not known: samples need only 40 lights")) << text;
}

TEST(PresetRanking, more_samples_are_the_remedy_for_few) {
  const auto text_of = [](const Json& result_case, const Json& config) {
    return ranking_of_cases(Json::array({result_case}), config)["text"].get<std::string>();
  };
  Json surfaces = with_few_samples(preset_case("bevy", 1e3, 1e4, 4e5), 100);
  const std::string rays = text_of(surfaces, {{"samples", {{"opaque", {{"divisor", 16}}}}}});
  EXPECT_NE(rays.find("--set samples.opaque.divisor=4 takes more"), std::string::npos) << rays;
  surfaces["cost"]["sets"] = {{"volume", {{"samples", 2e6}}}};
  surfaces["shading"] = surfaces["samples"]["opaque"];
  surfaces["shading"]["samples"] = 30720;  // of 30 frames
  surfaces.erase("samples");
  const std::string points = text_of(surfaces, Json::object());
  EXPECT_NE(points.find("--set shading.samples=16000 takes more"), std::string::npos) << points;
  const std::size_t floor = points.find("--set samples.opaque.ground=lowest");
  EXPECT_EQ(points.find("--set samples.opaque.ground=lowest", floor + 1), std::string::npos) << "once: " << points;
}

TEST(PresetRanking, a_view_without_lights_says_so_and_asks_for_no_samples) {
  Json empty = with_few_samples(preset_case("bevy", 1e3, 1e4, 4e5), 0);
  const std::string unseen = ranking_of_cases(Json::array({empty}))["text"];
  EXPECT_TRUE(unseen.starts_with("which preset suits is not known: no light reaches any of 1000 samples; ")) << unseen;
  empty["lights_in_view"] = {{"mean", 0}, {"max", 0}};
  const Json ranking = ranking_of_cases(Json::array({empty}));
  EXPECT_EQ(ranking["text"], "which preset suits is not known: no light is in view in any frame");
  EXPECT_EQ(ranking["best"], Json());
}

TEST(PresetRanking, few_lights_make_costs_rough_where_nothing_is_lost) {
  const Json whole = with_few_samples(preset_case("bevy", 1e3, 1e4, 4e5), 99);
  const std::string text = ranking_of_cases(Json::array({whole}))["text"];
  EXPECT_NE(text.find("samples need only 99 lights, summed over all samples, so costs are rough; "), std::string::npos)
      << text;
  EXPECT_EQ(text.find("not ranked"), std::string::npos) << text;
}

TEST(PresetRanking, pairs_that_a_limit_removes_are_not_those_of_the_method) {
  const auto why_of = [](const Json& result_case) {
    return ranking_of_cases(Json::array({result_case}))["cases"][0]["why"].get<std::string>();
  };
  Json limited = over_a_limit(preset_case("playcanvas", 0, 1e4, 1e5));
  EXPECT_NE(why_of(limited).find("takes 255 lights; the limit removes 450 pairs of 3000"), std::string::npos)
      << why_of(limited);
  EXPECT_EQ(why_of(limited).find("method"), std::string::npos) << why_of(limited);
  limited["error"]["false_negatives"] = 457;
  EXPECT_NE(why_of(limited).find("its test misses cells that the light reaches: 7 pairs of 3000"), std::string::npos)
      << why_of(limited);
}

TEST(PresetRanking, pairs_of_lights_beside_the_view_are_no_loss) {
  Json culled = preset_case("playcanvas", 0, 1e4, 1e5);
  culled["error"] = {{"false_negatives", 80}, {"true_pairs", 3000}};
  culled["pre_cull"] = {{"lost_pairs", 80}, {"over_limit", {{"lights", Json::array()}, {"lost_pairs", 0}}}};
  const Json cases = Json::array({culled});
  const Json ranking = ranking_of_cases(cases);
  const std::string why = ranking["cases"][0]["why"];
  EXPECT_TRUE(why.starts_with("loses nothing;")) << why;
  const std::string table = preset_table_of(ranking, cases);
  EXPECT_EQ(table.find(" 80 "), std::string::npos) << table;
  EXPECT_EQ(ranking_of_cases(Json::array({with_few_samples(culled, 5)}))["cases"][0]["standing"], "lists");
}

TEST(PresetRanking, structures_that_samples_search_are_ranked_apart_and_are_never_the_best) {
  const Json ranking =
      ranking_of_cases({searched(preset_case("godot", 0, 1e4, 1e5)), preset_case("filament", 1e3, 1e4, 4e5),
                        searched(preset_case("babylon", 0, 1e4, 3e5))});
  EXPECT_EQ(order(ranking), (Names{"filament", "godot", "babylon"}));
  EXPECT_EQ(ranking["best"], "id-filament");
  EXPECT_EQ(line_of(ranking, "godot")["standing"], "searched");
  EXPECT_EQ(line_of(ranking, "godot")["place"], 1);
  const std::string text = ranking["text"];
  EXPECT_NE(text.find("no GPU has measured what samples search: godot, babylon"), std::string::npos) << text;
}

TEST(PresetRanking, costs_that_the_model_cannot_tell_apart_share_a_place) {
  const Json ranking =
      ranking_of_cases({preset_case("filament", 1e3, 1e4, 1.00e5), preset_case("bevy", 1e3, 1e4, 1.04e5),
                        preset_case("playcanvas", 1e3, 1e4, 2e5)});
  EXPECT_EQ(line_of(ranking, "filament")["place"], 1);
  EXPECT_EQ(line_of(ranking, "bevy")["place"], 1);
  EXPECT_EQ(line_of(ranking, "playcanvas")["place"], 3);
  EXPECT_EQ(ranking["alike"], Json({"id-filament", "id-bevy"}));
  const std::string text = ranking["text"];
  EXPECT_TRUE(text.starts_with("take filament or bevy: no difference beyond 5")) << text;
  EXPECT_NE(text.find("playcanvas, the next, costs 1.90 times as much"), std::string::npos) << text;
}

TEST(PresetRanking, an_order_that_turns_with_the_prices_is_none) {
  const measure::FrameCost loops{{}, 0.0, 0.0, 0.0, 100.0}, reads{{}, 0.0, 0.0, 130.0, 0.0};
  EXPECT_TRUE(are_alike(loops, reads));
  const measure::FrameCost both{{}, 0.0, 0.0, 30.0, 100.0}, twice{{}, 0.0, 0.0, 60.0, 200.0};
  EXPECT_FALSE(are_alike(both, twice)) << "twice as much at any price";
  const std::string text =
      ranking_of_cases({preset_case("filament", 0.0, 0.0, 1e5), preset_case("bevy", 0.0, 1.3e5, 0.0),
                        preset_case("doom-2016", 0.0, 0.0, 9e5)})["text"];
  EXPECT_TRUE(
      text.starts_with("take filament or bevy: no difference that the model can show (0.1 ms to 0.13 ms of the "
                       "GPU a frame), since its prices of upload, reading and shading may each be off by 2 times"))
      << text;
}

TEST(PresetRanking, what_is_known_from_memory_alone_is_taken_only_where_all_is) {
  const Json ranking = ranking_of_cases({preset_case("unreal", 0, 1e4, 2e5), preset_case("filament", 1e3, 1e4, 4e5)});
  EXPECT_EQ(order(ranking), (Names{"unreal", "filament"}));
  EXPECT_EQ(ranking["best"], "id-filament");
  EXPECT_EQ(ranking["alike"], Json({"id-filament"}));
  const std::string text = ranking["text"];
  EXPECT_TRUE(text.starts_with("take filament, which costs the GPU least of upload, reading and shading: 0.411 ms"))
      << text;
  EXPECT_NE(text.find("; unreal would cost 0.21 ms, but is modelled from memory alone"), std::string::npos) << text;
  const Json alone = ranking_of_cases(Json::array({preset_case("unreal", 0, 1e4, 2e5)}));
  EXPECT_EQ(alone["best"], "id-unreal");
  EXPECT_NE(alone["text"].get<std::string>().find("unreal: from memory alone"), std::string::npos) << alone["text"];
}

TEST(PresetRanking, what_a_gpu_pays_to_make_lists_is_said_not_to_be_counted) {
  const std::string gpu = ranking_of_cases(
                        {preset_case("three-js", 0, 1e4, 2e5), preset_case("filament", 1e3, 1e4, 4e5)})["text"],
                    cpu = ranking_of_cases(
                        {preset_case("three-js", 0, 1e4, 9e5), preset_case("filament", 1e3, 1e4, 4e5)})["text"];
  EXPECT_NE(gpu.find("(what a GPU pays to make lists itself is not counted)"), std::string::npos) << gpu;
  EXPECT_EQ(cpu.find("is not counted"), std::string::npos) << cpu;
}

TEST(PresetRanking, a_place_is_behind_all_that_are_known_to_be_better_and_no_others) {
  const Json ranking =
      ranking_of_cases({preset_case("playcanvas", 4857, 808, 1485), preset_case("bevy", 9700, 1700, 3000),
                        preset_case("three-js", 0, 14298, 1094)});
  EXPECT_EQ(line_of(ranking, "bevy")["place"], 2) << "twice as dear at any price";
  EXPECT_EQ(line_of(ranking, "three-js")["place"], 1) << "cheaper where uploads are dear and reading is cheap";
  EXPECT_EQ(ranking["alike"], Json({"id-playcanvas", "id-three-js"}));
}

TEST(PresetRanking, what_few_samples_leave_open_is_not_counted_among_those_that_lack_lights) {
  Json open = over_a_limit(preset_case("filament", 1e3, 1e4, 1e5));
  const Json ranking = ranking_of_cases(
      {with_few_samples(open, 375), lacking(with_few_samples(preset_case("playcanvas", 0, 1e4, 1e5), 375), 375)});
  const std::string text = ranking["text"];
  EXPECT_NE(text.find("whether filament does is not known; of those that do not playcanvas lacks least"),
            std::string::npos)
      << text;
}

TEST(PresetRanking, a_grid_that_ends_before_the_view_is_not_acquitted_by_few_samples) {
  Json near = with_few_samples(preset_case("filament", 1e3, 1e4, 1e5), 60);
  EXPECT_EQ(ranking_of_cases(Json::array({near}))["cases"][0]["standing"], "lists");
  near["samples"]["opaque"]["unanswered"] = 58;
  const Json ranking = ranking_of_cases(Json::array({near}));
  EXPECT_EQ(ranking["cases"][0]["standing"], "unknown");
  const std::string why = ranking["cases"][0]["why"];
  EXPECT_NE(why.find("too few to tell whether it loses any beyond its grid"), std::string::npos) << why;
}

TEST(PresetRanking, a_grid_that_ends_behind_all_lights_is_acquitted_by_few_samples) {
  Json near = with_few_samples(preset_case("bevy", 1e3, 1e4, 1e5), 60);
  near["samples"]["opaque"]["unanswered"] = 58;
  near["lights_beyond_grid"] = {{"max", 1}, {"frames", 1}};
  EXPECT_EQ(ranking_of_cases(Json::array({near}))["cases"][0]["standing"], "unknown");
  near["lights_beyond_grid"] = {{"max", 0}, {"frames", 0}};
  EXPECT_EQ(ranking_of_cases(Json::array({near}))["cases"][0]["standing"], "lists");
  near["cost"]["sets"]["mirror"] = {{"samples", 1e3}};  // beside the view nothing is known
  near["samples"]["mirror"] = near["samples"]["opaque"];
  EXPECT_EQ(ranking_of_cases(Json::array({near}))["cases"][0]["standing"], "unknown");
}

TEST(PresetRanking, lights_that_a_limit_leaves_out_beyond_the_grid_count_too) {
  Json limited = over_a_limit(preset_case("filament", 1e3, 1e4, 1e5));
  limited["error"]["false_negatives"] = 0;  // they have no cells
  limited["pre_cull"]["lost_pairs"] = limited["pre_cull"]["over_limit"]["lost_pairs"] = 0;
  EXPECT_EQ(ranking_of_cases(Json::array({with_few_samples(limited, 60)}))["cases"][0]["standing"], "unknown");
}

TEST(PresetRanking, the_one_to_take_names_what_it_loses_itself) {
  const Json ranking =
      ranking_of_cases({lacking(preset_case("filament", 1e3, 1e4, 1e5), 4), preset_case("bevy", 1e3, 1e4, 4e5)});
  const std::string text = ranking["text"];
  EXPECT_NE(text.find("filament: samples lack 0.05 % of the lights that they need"), std::string::npos) << text;
  EXPECT_EQ(ranking["cases"][0]["unlit"], 0.0005);
}

TEST(PresetRanking, those_that_lack_equally_many_lights_are_named_together) {
  const Json as_many = lacking(preset_case("unreal", 1e3, 1e4, 1e5), 800);
  const std::string two = ranking_of_cases({lacking(preset_case("filament", 1e3, 1e4, 1e5), 800), as_many})["text"];
  EXPECT_NE(two.find("filament, unreal lack least, 10 %"), std::string::npos) << two;
  const std::string one = ranking_of_cases({lacking(preset_case("filament", 1e3, 1e4, 1e5), 700), as_many})["text"];
  EXPECT_NE(one.find("filament lacks least, "), std::string::npos) << one;
}

TEST(PresetRanking, cells_that_a_method_fills_itself_are_told_beside_what_its_test_misses) {
  Json boxes = lacking(preset_case("three-js", 0, 1e4, 1e5), 800);
  boxes["error"] = {{"false_negatives", 7}, {"true_pairs", 3000}};
  boxes["assigner"]["params"]["most"] = 64;
  boxes["occupancy"]["lights_per_cell"]["max"] = 64;
  const auto why = [&] { return ranking_of_cases(Json::array({boxes}))["cases"][0]["why"].get<std::string>(); };
  EXPECT_NE(why().find("or cells are full (room for 64 lights per cell): 7 pairs"), std::string::npos) << why();
  boxes["occupancy"]["lights_per_cell"]["max"] = 63;
  EXPECT_EQ(why().find("full"), std::string::npos) << why();
}

TEST(PresetRanking, lists_that_do_not_fit_lose_nothing_only_where_they_may_grow) {
  Json bevy = preset_case("bevy", 1e3, 1e4, 4e5);
  bevy["react"] = {{"to", "entries"}, {"most", 16384}, {"frames", {{"reacted", 5}, {"over", 6}}}};
  const std::string room =
      "loses nothing with storage buffers, where its lists grow, as the figures of its row are; without them there is "
      "room for 16384 entries, 6 of 30 frames do not fit";
  Json ranking = ranking_of_cases(Json::array({bevy}));
  EXPECT_NE(ranking["cases"][0]["why"].get<std::string>().find(room), std::string::npos) << ranking["cases"][0]["why"];
  EXPECT_NE(ranking["text"].get<std::string>().find(room), std::string::npos) << ranking["text"];
  bevy["react"]["frames"]["over"] = 0;
  ranking = ranking_of_cases(Json::array({bevy}));
  EXPECT_EQ(ranking["text"].get<std::string>().find("its lists grow"), std::string::npos) << ranking["text"];
}

TEST(PresetRanking, a_fallback_is_told_with_what_the_engine_takes_by_default) {
  const Json ranking = ranking_of_cases({preset_case("bevy", 1e3, 1e4, 1e5), preset_case("filament", 1e3, 1e4, 9e5)});
  const std::string remark = "the fallback on the CPU, whose lists are uploaded; the default since 0.19 is bevy-gpu";
  EXPECT_NE(line_of(ranking, "bevy")["why"].get<std::string>().find(remark), std::string::npos);
  EXPECT_NE(ranking["text"].get<std::string>().find("; bevy: " + remark), std::string::npos) << ranking["text"];
  EXPECT_EQ(line_of(ranking, "filament")["why"].get<std::string>().find("fallback"), std::string::npos);
}

TEST(PresetRanking, says_that_costs_depend_on_a_far_plane_that_the_camera_does_not_have_and_how_to_give_it) {
  const auto ending = [](const std::string& preset, double far_m, const std::string& note) {
    Json out = preset_case(preset, 0, 1e4, 1e5);
    out["grid"] = {{"slices", {{"boundaries", {0.1, 5.0, far_m}}}}, {"note", note}};
    return out;
  };
  const std::string none = run::k_no_far_plane;
  // As a result of an earlier version has it.
  const Json made_up = ending("black-mesa", 91.73,
                              "the camera has no far plane and slices.far is not set: the grid ends at 91.73 m, beyond "
                              "which no light of the path reaches, and lists depend on that"),
             own = ending("three-js", 2000, none + ": the grid ends at 2000 m, as that of the engine's own cameras"),
             follows = ending("bevy", 91, "slices follow the ranges of the lights in view");
  const std::string text = ranking_of_cases({made_up, own, follows})["text"];
  EXPECT_NE(text.find("costs depend on the far plane, which the camera does not have: slices end with that of the "
                      "engine's own cameras (three-js at 2000 m) and with the lights in view (black-mesa at 91.73 m); "
                      "--set 'scenes.*.far=METRES' gives cameras that of your game"),
            std::string::npos)
      << text;
  EXPECT_EQ(ranking_of_cases(Json::array({follows}))["text"].get<std::string>().find("far plane"), std::string::npos);
}

TEST(PresetRanking, older_results_have_no_places_and_are_shown) {
  const Json cases = Json::array({preset_case("filament", 1e3, 1e4, 1e5)});
  Json ranking{{"scene", "level"},
               {"camera", "walk"},
               {"viewport", {1920, 1080}},
               {"best", "id-filament"},
               {"cases", Json::array({{{"id", "id-filament"},
                                       {"preset", "filament"},
                                       {"gpu_ns", 1.0},
                                       {"lights_per_sample", 12.0},
                                       {"why", "loses nothing"}}})}};
  const std::string table = preset_table_of(ranking, cases);
  EXPECT_NE(table.find("filament loses nothing."), std::string::npos) << table;
}

}  // namespace
}  // namespace clusterbench::report
