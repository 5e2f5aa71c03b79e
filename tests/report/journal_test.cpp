#include "report/documents/journal.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "core/text.h"
#include "report/documents/compact_json.h"
#include "report/result_by_hand.h"
#include "run/records/records.h"

namespace clusterbench::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

const Json k_header{{"config", "a"}};

result::Case case_named(const std::string& id) {
  result::Case finished = run::record_of(testing::result_by_hand().cases[0]);
  finished.id = id;
  return finished;
}

result::Result result_named(const std::string& name) {
  result::Result result;
  result.name = name;
  return result;
}

std::string written(const result::Result& result) {
  return compact_json(result::to_json(result));
}

// As a run writes it.
std::string sealed(const Json& entry) {
  const std::string json = entry.dump(), text = json.substr(0, json.size() - 1);
  return text + R"(,"sha256":")" + sha256_hex(text) + "\"}";
}

std::string line_of(const Json& finished) {
  return sealed({{"case", finished}});
}

std::string line_of(const result::Case& finished) {
  return line_of(result::to_json(finished));
}

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class JournalTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "journal.XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    file_ = folder_ / "result.json";
  }
  void TearDown() override { fs::remove_all(folder_); }

  // What a run that dies after one case leaves behind.
  void leave_one_case() {
    Journal journal(file_, k_header, false, 100);
    journal.add_case(case_named("first"));
  }

  fs::path folder_, file_;
};

TEST_F(JournalTest, a_finished_case_survives_the_end_of_the_process) {
  leave_one_case();
  const Journal later(file_, k_header, true, 100);
  EXPECT_EQ(later.earlier_ids(), std::vector<std::string>{"first"});
}

TEST_F(JournalTest, a_link_stays_and_its_target_gets_the_result) {
  const fs::path target = folder_ / "kept" / "target.json", link = folder_ / "link.json";
  fs::create_directory(target.parent_path());
  fs::create_symlink("kept/target.json", file_);
  fs::create_symlink(file_, link);
  {
    Journal journal(link, k_header, false, 100);
    EXPECT_EQ(journal.partial_path(), target.string() + ".partial") << "where the next run looks for it, link or not";
    journal.finish(result_named("new"));
  }
  EXPECT_TRUE(fs::is_symlink(file_));
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_FALSE(fs::is_symlink(target));
  EXPECT_EQ(text_of(target), written(result_named("new")));
}

TEST_F(JournalTest, a_circle_of_links_is_an_error) {
  fs::create_symlink("other.json", file_);
  fs::create_symlink("result.json", folder_ / "other.json");
  EXPECT_THROW(Journal(file_, k_header, false, 100), Error);
}

TEST_F(JournalTest, a_line_cut_in_the_middle_is_passed_over) {
  leave_one_case();
  std::ofstream(file_.string() + ".partial", std::ios::app) << R"({"case": {"id": "seco)";
  const Journal later(file_, k_header, true, 100);
  EXPECT_EQ(later.earlier_ids(), std::vector<std::string>{"first"});
}

TEST_F(JournalTest, of_another_device_is_refused_with_both_names) {
  const auto header = [](const char* name, const char* uuid) {
    return Json{{"config", "a"}, {"device", {{"name", name}, {"driver", "1.0"}, {"uuid", uuid}}}};
  };
  const auto refusal_of = [&](const Json& earlier, const Json& now) -> std::string {
    fs::remove(file_.string() + ".partial");
    {
      Journal journal(file_, earlier, false, 100);
      journal.add_case(case_named("first"));
    }
    std::string told;
    try {
      finished_ids(file_, now);
    } catch (const Error& error) {
      told = error.message();
    }
    EXPECT_EQ(told.empty(), earlier == now);
    if (told.empty())
      EXPECT_EQ(Journal(file_, now, true, 100).earlier_ids().size(), 1u);
    else
      EXPECT_THROW(Journal(file_, now, true, 100), Error);
    return told;
  };
  const std::string end =
      "; --device NAME takes the same one, where it is there; without --resume the run begins anew and the file is "
      "kept "
      "under another name";
  EXPECT_EQ(refusal_of(header("RTX 4090", "01"), header("RTX 4090", "01")), "");
  EXPECT_EQ(refusal_of(header("RTX 4090", "01"), header("UHD 630", "02")),
            "is an interrupted run on RTX 4090, and this one is on UHD 630" + end);
  EXPECT_EQ(refusal_of(header("RTX 4090", "01"), header("RTX 4090", "02")),
            "is an interrupted run on RTX 4090, and this one is on another device or driver of that name" + end);
  EXPECT_EQ(refusal_of(header("RTX 4090", "01"), k_header),
            "is an interrupted run on RTX 4090, and this one is on no device" + end);
  EXPECT_EQ(refusal_of(k_header, header("RTX 4090", "01")),
            "is an interrupted run on no device, and this one is on RTX 4090" + end);
  Json other = header("UHD 630", "02");
  other["config"] = "b";
  EXPECT_TRUE(
      refusal_of(header("RTX 4090", "01"), other).starts_with("is an interrupted run of another configuration"));
  Json built = other;
  built["git_sha"] = "1";
  built["count"] = "perf";
  EXPECT_TRUE(refusal_of(k_header, built)
                  .starts_with("is an interrupted run of another build and configuration and --count and device; "))
      << refusal_of(k_header, built);
  for (const char* broken : {"7", "null", R"({"name": 7})", R"({"uuid": "01"})", "[]"}) {
    Json mangled = k_header;
    mangled["device"] = Json::parse(broken);
    EXPECT_TRUE(refusal_of(mangled, header("RTX 4090", "01"))
                    .starts_with("is an interrupted run on a device without a name, and this one is on RTX 4090"))
        << broken;
  }
}

TEST_F(JournalTest, of_another_machine_is_kept_aside_and_not_gone_on_with) {
  const auto header = [](const char* host, const char* config) {
    return Json{{"config", config}, {"machine", {{"cpu", "A"}, {"host", host}}}, {"device", {{"uuid", host}}}};
  };
  const Json here = header("1", "a"), there = header("2", "a");
  { Journal(file_, here, false, 100).add_case(case_named("first")); }
  EXPECT_EQ(finished_ids(file_, here).size(), 1u);
  EXPECT_EQ(finished_ids(file_, there).size(), 0u);
  EXPECT_THROW(Journal(file_, header("2", "b"), true, 100), Error) << "another configuration is refused as ever";
  EXPECT_THROW(Journal(file_, k_header, true, 100), Error) << "and a run without times";
  fs::path aside;
  {
    Journal journal(file_, there, true, 100);
    EXPECT_TRUE(journal.is_empty());
    EXPECT_TRUE(journal.is_set_aside_of_other_machine());
    aside = journal.set_aside();
    journal.add_case(case_named("second"));
  }
  EXPECT_EQ(Journal(file_, there, true, 100).earlier_ids(), std::vector<std::string>{"second"});
  fs::rename(aside, file_.string() + ".partial");
  EXPECT_EQ(Journal(file_, here, true, 100).earlier_ids(), std::vector<std::string>{"first"});
}

// Only the last line can be cut by the end of a run.
TEST_F(JournalTest, another_broken_line_is_an_error_that_names_it) {
  const auto refusal_with = [&](const std::string& line) -> std::string {
    fs::remove(file_.string() + ".partial");
    leave_one_case();
    std::ofstream(file_.string() + ".partial", std::ios::app) << line << "\n" << line_of(case_named("third")) << "\n";
    try {
      Journal(file_, k_header, true, 100);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal_with(line_of(case_named("second"))), "");
  EXPECT_NE(refusal_with(R"({"case": {"id": "seco)").find("line 3: is not what a run writes"), std::string::npos);
  EXPECT_NE(refusal_with("7").find("line 3: is not what a run writes"), std::string::npos);
  EXPECT_NE(refusal_with(line_of(Json{{"id", 7}})).find("does not hold the cases of a run: /1"), std::string::npos);
}

TEST_F(JournalTest, a_new_start_sets_finished_cases_aside_under_a_name_that_is_free) {
  const std::string partial = file_.string() + ".partial";
  leave_one_case();
  const std::string kept = text_of(partial);
  std::ofstream(partial + ".1") << "set aside before";
  const Journal fresh(file_, k_header, false, 100);
  EXPECT_TRUE(fresh.earlier_ids().empty());
  EXPECT_EQ(fresh.set_aside(), partial + ".2");
  EXPECT_EQ(text_of(partial + ".2"), kept);
  EXPECT_EQ(text_of(partial + ".1"), "set aside before");
}

TEST_F(JournalTest, a_new_start_sets_aside_what_no_run_wrote_too) {
  std::ofstream(file_.string() + ".partial") << "notes";
  EXPECT_EQ(text_of(Journal(file_, k_header, false, 100).set_aside()), "notes");
}

TEST_F(JournalTest, a_run_that_died_before_its_first_case_leaves_nothing_to_keep) {
  std::ofstream(file_.string() + ".partial") << R"({"header":{"config":"b"}})"
                                             << "\n";
  const Journal fresh(file_, k_header, false, 100);
  EXPECT_EQ(fresh.set_aside(), "");
  EXPECT_EQ(text_of(fresh.partial_path()), sealed({{"header", k_header}}) + "\n");
}

TEST_F(JournalTest, a_line_that_was_edited_and_a_case_twice_are_not_gone_on_with) {
  leave_one_case();
  const std::string partial = file_.string() + ".partial", kept = text_of(partial);
  const auto is_refused = [&](const std::string& text) {
    std::ofstream(partial, std::ios::binary) << text;
    EXPECT_THROW(Journal(file_, k_header, true, 100), Error);
    EXPECT_THROW(finished_ids(file_, k_header), Error);
    EXPECT_EQ(text_of(partial), text);
  };
  std::string edited = kept;
  const std::size_t digit = edited.find_last_of("123456789", edited.rfind("sha256"));
  ASSERT_NE(digit, std::string::npos);
  edited[digit] = static_cast<char>(edited[digit] == '9' ? '1' : edited[digit] + 1);
  is_refused(edited);
  is_refused(kept + kept.substr(kept.find('\n') + 1));
}

// Whatever is changed, not only what a case holds; but each line stands for itself.
TEST_F(JournalTest, a_change_anywhere_in_a_line_is_not_gone_on_with) {
  {
    Journal journal(file_, k_header, false, 100);
    journal.add_case(case_named("first"));
    journal.add_case(case_named("second"));
    journal.add_answer({{"ids", {"third"}}}, {{"methods", {1, 2}}});
  }
  const std::string partial = file_.string() + ".partial", kept = text_of(partial);
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < kept.size(); begin += lines.back().size())
    lines.push_back(kept.substr(begin, kept.find('\n', begin) + 1 - begin));
  ASSERT_EQ(lines.size(), 4u);
  const auto refusal_of = [&](const std::string& text) -> std::string {
    std::ofstream(partial, std::ios::binary) << text;
    try {
      Journal(file_, k_header, true, 100);
    } catch (const Error& error) {
      EXPECT_THROW(finished_ids(file_, k_header), Error);
      return error.where();
    }
    return "";
  };
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto with = [&](std::string line) {
      std::string text;
      for (std::size_t k = 0; k < lines.size(); ++k) text += k == i ? line : lines[k];
      return text;
    };
    const std::string& line = lines[i];
    const std::string at = "line " + std::to_string(i + 1);
    EXPECT_EQ(refusal_of(with(R"({"note":1,)" + line.substr(1))), at) << "a key more";
    EXPECT_EQ(refusal_of(with(line.substr(0, line.size() - 2) + R"(,"note":1})" + "\n")), at) << "behind the digest";
    EXPECT_EQ(refusal_of(with("{ " + line.substr(1))), at) << "a blank within";
    EXPECT_EQ(refusal_of(with(" " + line)), at) << "a blank before";
    EXPECT_EQ(refusal_of(with(line.substr(0, line.size() - 1) + "\r\n")), at);
    EXPECT_EQ(refusal_of(with("\xEF\xBB\xBF" + line)), at) << "a byte order mark";
    EXPECT_EQ(refusal_of(with("\n" + line)), at) << "an empty line";
    EXPECT_EQ(refusal_of(with(line)), "");
  }
  EXPECT_EQ(refusal_of(lines[0] + lines[2] + lines[3] + lines[1]), "") << "in another order";
  EXPECT_EQ(refusal_of(lines[0] + lines[2]), "") << "measured again";
}

// Texts that no run has left, with and without an end of line.
TEST_F(JournalTest, what_is_no_journal_is_neither_cut_nor_removed) {
  const std::string partial = file_.string() + ".partial";
  leave_one_case();
  const std::string whole = text_of(partial);
  for (const std::string& text : {std::string("garbage"), std::string("notes\n"), std::string(R"({"header": 1)"),
                                  std::string("{\"header\": 1}\n"), std::string("{\"header\":{\"config\":\"b\""),
                                  whole + "my notes", whole + "{\"cases"}) {
    std::ofstream(partial, std::ios::binary) << text;
    EXPECT_THROW(Journal(file_, k_header, true, 100), Error) << text;
    EXPECT_EQ(text_of(partial), text);
    const fs::path aside = Journal(file_, k_header, false, 100).set_aside();
    EXPECT_EQ(text_of(aside), text);
    fs::remove(aside);
  }
}

TEST_F(JournalTest, the_beginning_of_a_header_is_begun_anew) {
  for (const bool resume : {false, true}) {
    std::ofstream(file_.string() + ".partial") << R"({"header":{"con)";
    EXPECT_EQ(Journal(file_, k_header, resume, 100).set_aside(), "");
    EXPECT_FALSE(fs::exists(file_.string() + ".partial"));
  }
}

TEST_F(JournalTest, nothing_is_written_through_a_link_in_its_place) {
  const fs::path partial = file_.string() + ".partial", victim = folder_ / "victim";
  fs::create_symlink("victim", partial);
  for (const bool is_there : {false, true}) {
    if (is_there) std::ofstream(victim) << "";
    for (const bool resume : {false, true}) EXPECT_THROW(Journal(file_, k_header, resume, 100), Error);
    EXPECT_EQ(fs::exists(victim), is_there);
    EXPECT_TRUE(fs::is_symlink(partial));
  }
}

TEST_F(JournalTest, a_start_that_is_refused_and_one_that_measures_nothing_leave_no_file) {
  EXPECT_THROW(Journal(file_, k_header, false, std::uint64_t{1} << 62), Error);
  EXPECT_TRUE(fs::is_empty(folder_));
  Journal(file_, k_header, false, 100);
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(JournalTest, a_second_run_to_the_same_file_is_refused_while_the_first_goes_on) {
  Journal first(file_, k_header, false, 100);
  first.add_case(case_named("first"));
  for (const bool resume : {false, true}) {
    try {
      const Journal second(file_, k_header, resume, 100);
      ADD_FAILURE() << "both write";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("another run is writing here"), std::string::npos) << error.what();
    }
  }
  first.finish(result_named("whole"));
  EXPECT_EQ(text_of(file_), written(result_named("whole")));
  const Journal later(file_, k_header, false, 100);
  EXPECT_EQ(later.set_aside(), "");
}

// The second goes on with one end of the file cut off and the other added.
TEST_F(JournalTest, a_resumed_run_can_die_and_be_resumed) {
  leave_one_case();
  std::ofstream(file_.string() + ".partial", std::ios::app) << R"({"case": {"id": "seco)";
  Journal(file_, k_header, true, 100).add_case(case_named("second"));
  const Journal later(file_, k_header, true, 100);
  EXPECT_EQ(later.earlier_ids(), (std::vector<std::string>{"first", "second"}));
}

TEST_F(JournalTest, the_setting_and_the_scene_that_changed_are_named) {
  const auto header = [](const Json& rounds, const char* sha256) {
    const Json street{{"path", "street.glb"}}, hall{{"path", "hall.glb"}};
    return Json{{"scenes", {"1", sha256}},
                {"config", {{"scenes", {street, hall}}, {"timing", {{"rounds", rounds}, {"measure", true}}}}}};
  };
  { Journal(file_, header(5, "2"), false, 100).add_case(case_named("first")); }
  const auto refusal_of = [&](const Json& now) {
    try {
      finished_ids(file_, now);
    } catch (const Error& error) {
      const std::string told = error.message();
      return told.substr(0, told.find("; without --resume"));
    }
    return std::string();
  };
  EXPECT_EQ(refusal_of(header(5, "2")), "");
  EXPECT_EQ(refusal_of(header(7, "2")), "is an interrupted run of another configuration (/timing/rounds was 5, is 7)");
  EXPECT_EQ(refusal_of(header(5, "3")), "is an interrupted run of another scene (hall.glb)");
  EXPECT_EQ(refusal_of(header(Json(std::string(100, 'x')), "3")),
            "is an interrupted run of another configuration (/timing/rounds was 5, is a text of 102 bytes) and scene "
            "(hall.glb)");
  Json several = header(5, "3");  // two scenes of one entry
  several["config"]["scenes"] = {{{"paths", {"street.glb", "hall.glb"}}}, {{"path", "new.glb"}}};
  several["scenes"].push_back("4");
  EXPECT_TRUE(refusal_of(several).ends_with(") and scene"));
  Json longer = header(5, "2");
  longer["config"]["scenes"].push_back({{"path", "new.glb"}});
  longer["scenes"].push_back("3");
  EXPECT_EQ(refusal_of(longer),
            "is an interrupted run of another configuration (/scenes/2 was absent, is {\"path\":\"new.glb\"}) and "
            "scene (new.glb)");
}

TEST_F(JournalTest, another_configuration_is_not_continued) {
  leave_one_case();
  EXPECT_THROW(Journal(file_, Json{{"config", "b"}}, true, 100), Error);
}

TEST_F(JournalTest, finishing_replaces_the_file_and_removes_the_journal) {
  std::ofstream(file_) << "old";
  Journal journal(file_, k_header, false, 100);
  journal.add_case(case_named("first"));
  journal.finish(result_named("whole"));
  EXPECT_EQ(text_of(file_), written(result_named("whole")));
  EXPECT_FALSE(fs::exists(journal.partial_path()));
}

TEST_F(JournalTest, a_folder_that_does_not_exist_is_an_error_at_the_start) {
  EXPECT_THROW(Journal(folder_ / "none" / "r.json", k_header, false, 100), Error);
  EXPECT_THROW(Journal(folder_, k_header, false, 100), Error);
}

TEST_F(JournalTest, a_disk_without_room_is_an_error_at_the_start) {
  EXPECT_THROW(Journal(file_, k_header, false, std::uint64_t{1} << 62), Error);
  EXPECT_FALSE(fs::exists(file_.string() + ".partial"));
}

TEST_F(JournalTest, what_is_left_is_told_without_a_change_on_disk) {
  EXPECT_EQ(finished_ids(file_, k_header), std::vector<std::string>{});
  EXPECT_FALSE(fs::exists(file_.string() + ".partial"));
  leave_one_case();
  const std::string before = text_of(file_.string() + ".partial");
  EXPECT_EQ(finished_ids(file_, k_header), std::vector<std::string>{"first"});
  EXPECT_EQ(text_of(file_.string() + ".partial"), before);
  EXPECT_THROW(finished_ids(file_, Json{{"config", "b"}}), Error);
}

}  // namespace
}  // namespace clusterbench::report
