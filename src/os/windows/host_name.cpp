#include "os/host_name.h"

#include <array>

#include "os/windows/windows_api.h"

namespace clusterbench::os {

std::string host_name() {
  std::array<wchar_t, 256> name{};
  auto length = static_cast<DWORD>(name.size());
  return ::GetComputerNameExW(ComputerNameDnsHostname, name.data(), &length) != 0 ? narrow({name.data(), length}) : "";
}

}  // namespace clusterbench::os
