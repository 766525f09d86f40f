// write_sample FILE: the report of the synthetic run, for browser tests.
#include "recorder/report/report.h"
#include "tests/recorder/report/synthetic_run.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  crosswalk::recording::write_report(argv[1], crosswalk::recording::synthetic::report_input());
  return 0;
}
