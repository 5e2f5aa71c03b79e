#include "cli/options/export_files.h"

#include "core/error.h"

namespace clusterbench::cli {
namespace {

ExportTarget target_of(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals + 1 == text.size())
    throw Error("", "--export", "takes FORMAT=FILE, not '" + text + "'");
  return {&report::export_format(text.substr(0, equals)), text.substr(equals + 1)};
}

}  // namespace

std::vector<ExportTarget> export_targets(const std::vector<std::string>& texts) {
  std::vector<ExportTarget> targets;
  targets.reserve(texts.size());
  for (const std::string& text : texts) targets.push_back(target_of(text));
  return targets;
}

ExportFiles::ExportFiles(const std::vector<ExportTarget>& targets, bool are_times_measured) : targets_(targets) {
  for (const ExportTarget& target : targets)
    if (target.format->needs_times && !are_times_measured)
      throw Error(
          "", "--export",
          std::string(target.format->name) + " takes times, which --no-timing (timing.measure: false) leaves out");
  for (const ExportTarget& target : targets) {
    files_.push_back(std::make_unique<os::OutputFile>(target.file));
    files_.back()->probe();
  }
}

void ExportFiles::write(const result::Result& result) const {
  std::vector<std::string> texts;
  texts.reserve(targets_.size());
  for (const ExportTarget& target : targets_) texts.push_back(report::exported(result, *target.format, false));
  for (std::size_t i = 0; i < files_.size(); ++i) files_[i]->write(texts[i]);
}

std::string export_formats_text() {
  std::string text;
  for (const report::ExportFormat& format : report::export_formats())
    text += "  " + std::string(format.name) + std::string(18 - format.name.size(), ' ') + std::string(format.summary) +
            "\n";
  return text;
}

}  // namespace clusterbench::cli
