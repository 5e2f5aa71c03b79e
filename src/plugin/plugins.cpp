#include "plugin/plugins.h"

#include <algorithm>
#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <locale>
#include <optional>
#include <set>

#include "core/error.h"
#include "core/file_text.h"
#include "core/text.h"
#include "os/call_notes.h"
#include "os/environment.h"
#include "os/shared_library.h"
#include "os/surroundings.h"
#include "plugin/plugin_call.h"
#include "plugin/plugin_method.h"

namespace clusterbench::plugin {
namespace {

namespace fs = std::filesystem;

constexpr const char* k_entry = "clusterbench_plugin_entry";

void write_log(const char* text) {
  std::fprintf(stderr, "%s\n", printable(text == nullptr ? "" : text).c_str());
}

const void* extension(const char* name) {
  static const clusterbench_log log{sizeof log, write_log};
  return name != nullptr && std::string_view(name) == CLUSTERBENCH_LOG ? &log : nullptr;
}

const clusterbench_host& host() {
  static const clusterbench_host described{sizeof described, CLUSTERBENCH_PLUGIN_MAJOR, CLUSTERBENCH_PLUGIN_MINOR,
                                           "clusterbench",   CLUSTERBENCH_VERSION,      extension};
  return described;
}

std::string content_of_library(const fs::path& file) {
  std::string content = file_text(file);
  const std::string obstacle = os::library_obstacle(content);
  if (!obstacle.empty()) throw Error(file.string(), "", obstacle + "; takes a plug-in, see docs/plugins.md");
  return content;
}

[[noreturn]] void refuse_exception(const fs::path& file, const std::string& doing, const CallEnd& end) {
  throw Error(file.string(), "",
              "an exception left " + doing + ": " + end.exception + "; allowed: none leaves a function of a plug-in");
}

// Runs what the library runs as it is loaded (constructors).
os::SharedLibrary loaded_library(const fs::path& file) {
  CallEnd end;
  std::optional<os::SharedLibrary> library;
  std::optional<Error> refused;
  const bool is_loaded = returned(end, [&] {
    try {
      library.emplace(file);
    } catch (const Error& error) {
      refused = error;
    }
  });
  if (!is_loaded) refuse_exception(file, "what it runs as it is loaded", end);
  if (refused) throw Error(*refused);
  return *library;
}

// Numbers are read and written as in the locale C, whatever a library sets as it is loaded, for C or for C++.
class KeptLocale {
 public:
  KeptLocale() = default;
  KeptLocale(const KeptLocale&) = delete;
  KeptLocale& operator=(const KeptLocale&) = delete;
  ~KeptLocale() {
    std::locale::global(streams_);
    std::setlocale(LC_ALL, name_.c_str());
  }

 private:
  std::string name_ = std::setlocale(LC_ALL, nullptr);
  std::locale streams_;
};

PluginFacts facts_of(const fs::path& file, const std::string& id) {
  const KeptLocale kept;
  const os::Surroundings before;
  // Libraries that are built with -ffast-math change the mode of numbers as they are loaded; it is set back.
  CallEnd end;
  return called({os::note_code(file.filename().string()), 0}, os::CallStep::load, -1, end, [&] {
    const os::SharedLibrary library = loaded_library(file);
    using Entry = const clusterbench_plugin* (*)(const clusterbench_host*);
    const auto entry = reinterpret_cast<Entry>(library.symbol(k_entry));
    if (entry == nullptr)
      throw Error(file.string(), "", std::string("is no plug-in: it exports no function ") + k_entry + "()");
    const clusterbench_plugin* given = nullptr;
    if (!returned(end, [&] { given = entry(&host()); })) refuse_exception(file, std::string(k_entry) + "()", end);
    PluginFacts facts = read_plugin(file.string(), given, id);
    facts.changes_on_loading = before.changes();
    return facts;
  });
}

std::string why_unavailable(const MethodFacts& method) {
  if (method.unknown_needs == 0) return "";
  return "it needs what this version of the program does not have (bits " + std::to_string(method.unknown_needs) +
         " of `needs`)";
}

struct Registered {
  LoadedPlugin plugin;
  std::deque<assign::AssignerRegistration> methods;
};

std::deque<Registered>& loaded() {
  static std::deque<Registered> all = [] {
    assign::assigner_descriptors();  // makes the registry, which must end after what is registered
    return std::deque<Registered>();
  }();
  return all;
}

// References to a plug-in's parts stay valid: it is never unloaded.
assign::AssignerDescriptor runnable(const MethodFacts& method, const std::string& file) {
  assign::AssignerDescriptor descriptor = method.descriptor;
  descriptor.make = [&method, file](const assign::Params& params) -> std::unique_ptr<assign::ListAssigner> {
    return std::make_unique<PluginMethod>(method, file, params);
  };
  descriptor.unavailable = [&method](const assign::Params&) { return why_unavailable(method); };
  return descriptor;
}

const Registered* same_file(const fs::path& file) {
  for (const Registered& one : loaded())
    if (one.plugin.file == file) return &one;
  return nullptr;
}

fs::path absolute_path(const fs::path& file) {
  std::error_code failed;
  const fs::path canonical = fs::canonical(file, failed);
  return failed ? fs::absolute(file) : canonical;
}

// What is no file, and has an equals sign, was meant as ID=FILE.
void check_name(const fs::path& given) {
  if (given.empty()) throw Error("", "", "names no file of a plug-in; takes FILE or ID=FILE");
  std::error_code none;
  if (given.string().find('=') == std::string::npos || fs::exists(given, none)) return;
  throw Error(
      given.string(), "",
      "is no file, and what stands before '=' is no ID, which has lower-case letters, digits and '-', begins with "
      "a letter and has at most 64 of them");
}

std::vector<fs::path> folders_on_path() {
  const std::vector<std::string> named = os::folders_in_variable(k_path_variable);
  return {named.begin(), named.end()};
}

}  // namespace

PluginName plugin_name(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || !is_name(std::string_view(text).substr(0, equals))) return {"", text};
  return {text.substr(0, equals), text.substr(equals + 1)};
}

std::string LoadedPlugin::text() const {
  return PluginName{given_id, file.string()}.text();
}

const LoadedPlugin& load_plugin(const fs::path& given, const std::string& id) {
  check_name(given);
  const fs::path file = absolute_path(given);
  const std::string sha256 = sha256_hex(content_of_library(file));
  if (const Registered* before = same_file(file)) {
    if (before->plugin.sha256 != sha256)
      throw Error(file.string(), "", "has changed since it was loaded; start the program again");
    if (before->plugin.given_id != id)
      throw Error(file.string(), "",
                  "is loaded already, with the id '" + before->plugin.facts.id + "'; a copy of it can have another");
    return before->plugin;
  }
  PluginFacts facts = facts_of(file, id);
  if (const LoadedPlugin* other = find_plugin(facts.id))
    throw Error(file.string(), "",
                "has the id '" + facts.id + "', and so has " + other->file.string() + "; ID=FILE gives it another");
  Registered& added = loaded().emplace_back();
  added.plugin = {file, sha256, std::move(facts), id};
  for (const MethodFacts& method : added.plugin.facts.methods)
    added.methods.emplace_back(runnable(method, file.string()));
  return added.plugin;
}

const LoadedPlugin* find_plugin(const std::string& id) {
  for (const Registered& one : loaded())
    if (one.plugin.facts.id == id) return &one.plugin;
  return nullptr;
}

const LoadedPlugin* find_plugin_of_file(const std::string& name) {
  for (const Registered& one : loaded())
    if (one.plugin.file.filename() == name + ".so") return &one.plugin;
  return nullptr;
}

PluginFacts describe_plugin(const fs::path& given) {
  const fs::path file = absolute_path(given);
  content_of_library(file);
  return facts_of(file, "");
}

fs::path file_on_path(const std::string& id) {
  std::error_code failed;
  for (const fs::path& folder : folders_on_path())
    if (fs::path file = folder / (id + ".so"); fs::is_regular_file(file, failed)) return file;
  return {};
}

std::string path_text() {
  std::string text;
  for (const fs::path& folder : folders_on_path()) {
    std::error_code none;
    const bool is_there = fs::is_directory(folder, none);
    text += (text.empty() ? "has " : ", ") + folder.string() +
            (is_there                   ? ""
             : fs::exists(folder, none) ? " (is no folder)"
                                        : " (does not exist)");
  }
  return text.empty() ? "is not set" : text;
}

std::vector<fs::path> files_on_path() {
  std::vector<fs::path> files;
  std::set<fs::path> names;
  for (const fs::path& folder : folders_on_path()) {
    std::vector<fs::path> here;
    std::error_code failed;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, failed))
      if (entry.path().extension() == ".so" && names.insert(entry.path().filename()).second)
        here.push_back(entry.path());
    std::ranges::sort(here);
    files.insert(files.end(), here.begin(), here.end());
  }
  return files;
}

}  // namespace clusterbench::plugin
