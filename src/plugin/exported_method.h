#pragma once
// The other direction: a method that is written against the program's own classes (CONTRIBUTING.md) as a method of a
// plug-in. So the same file can be one of the program's methods and a plug-in.

#include <memory>
#include <vector>

#include "assign/contract/assigner.h"
#include "plugin/clusterbench_plugin.h"

namespace clusterbench::plugin {

class ExportedMethod {
 public:
  // `descriptor` must outlive this object, and have the form with lists.
  explicit ExportedMethod(const assign::AssignerDescriptor& descriptor);
  ~ExportedMethod();
  ExportedMethod(const ExportedMethod&) = delete;
  ExportedMethod& operator=(const ExportedMethod&) = delete;

  const clusterbench_method* table() const;

 private:
  struct Table;
  std::unique_ptr<Table> table_;
};

}  // namespace clusterbench::plugin
