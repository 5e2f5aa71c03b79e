#include "core/shared_threads.h"

namespace clusterbench {
namespace {

thread_local SharedThreads* lent_threads = nullptr;

}  // namespace

SharedThreads* shared_threads() {
  return lent_threads;
}

SharedThreadsScope::SharedThreadsScope(SharedThreads* threads) : before_(lent_threads) {
  lent_threads = threads;
}

SharedThreadsScope::~SharedThreadsScope() {
  lent_threads = before_;
}

}  // namespace clusterbench
