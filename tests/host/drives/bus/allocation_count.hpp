// Counts what this thread takes from the heap between two points.
#pragma once

namespace liana::test {

class AllocationCount {
 public:
  // Counting goes on from here...
  static void start();
  // ...to here.
  static void stop();
  static void clear();
  static int value();
};

}  // namespace liana::test
