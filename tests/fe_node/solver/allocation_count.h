// Counts calls of operator new in a test program that links allocation_count.cpp.
#pragma once

namespace crosswalk::fe {
long allocation_count();
}
