#include "report/page/page_costs.h"

#include <gtest/gtest.h>

#include "records.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

// Its lists take 3 us; 2 us of upload and 5 us of shading follow.
Json costly_case(const char* id, bool is_eligible) {
  return {
      {"id", id},
      {"eligible", is_eligible},
      {"timing", {{"frame_ns", {{"median", 3000.0}}}}},
      {"cost", {{"lit", true}, {"upload_ns", 2000.0}, {"shade_ns", 5000.0}, {"sets", {{"opaque", Json::object()}}}}}};
}

TEST(PageCosts, are_those_of_making_lists_and_of_what_the_model_adds) {
  Json untimed = costly_case("b", true), lossy = costly_case("c", false);
  untimed.erase("timing");
  const Json result{{"config", Json::object()}, {"cases", Json::array({costly_case("a", true), untimed, lossy})}};
  const std::vector<result::FrameCost> costs = page_costs(test::result_of(result));
  ASSERT_EQ(costs.size(), 2U) << "none of what loses lights";
  EXPECT_EQ(result::to_json(costs[0]), (Json{{"id", "a"}, {"ns", 10000.0}, {"gpu_ns", 7000.0}}));
  EXPECT_EQ(result::to_json(costs[1]), (Json{{"id", "b"}, {"ns", 7000.0}, {"gpu_ns", 7000.0}}));
}

TEST(PageCosts, are_not_those_of_engines_that_make_their_lists_on_the_gpu_and_were_timed_here) {
  Json preset = costly_case("a", true);
  preset["preset"] = "unreal";
  EXPECT_TRUE(page_costs(test::result_of({{"config", Json::object()}, {"cases", Json::array({preset})}})).empty());
}

TEST(PageCosts, are_not_those_of_presets_that_a_device_has_timed) {
  Json preset = costly_case("a", true);
  preset.erase("timing");
  preset["preset"] = "unreal";
  const auto costs_of = [&] {
    return page_costs(test::result_of({{"config", Json::object()}, {"cases", Json::array({preset})}})).size();
  };
  EXPECT_EQ(costs_of(), 1u) << "counted on the processor: the model's part";
  preset["assigner"] = {{"on_device", true}};
  preset["device"] = {{"run_ns", {{"median", 5000.0}}}};
  EXPECT_EQ(costs_of(), 0u);
}

TEST(PageCosts, are_none_without_a_model) {
  Json plain = costly_case("a", true);
  plain.erase("cost");
  EXPECT_TRUE(page_costs(test::result_of({{"config", Json::object()}, {"cases", Json::array({plain})}})).empty());
}

}  // namespace
}  // namespace clusterbench::report
