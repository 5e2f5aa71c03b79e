#pragma once
// Tests of what a build may lack say that they are skipped.

#include <gtest/gtest.h>

#include "core/libraries.h"

// At the beginning of a test or of a fixture's SetUp(): NEEDS(embree).
#define NEEDS(LIBRARY)                                                \
  if (!::clusterbench::is_built_in(::clusterbench::Library::LIBRARY)) \
  GTEST_SKIP() << ::clusterbench::missing_library(::clusterbench::Library::LIBRARY)
