// What every test program starts with.

#include <gmock/gmock.h>

#include "src/core/worker_threads.h"

int main(int argc, char** argv) {
  const promenade::WorkerThreads workers;
  testing::InitGoogleMock(&argc, argv);
  return RUN_ALL_TESTS();
}
