#include <iostream>
#include <string>
#include <vector>

#include "common/node_main.h"
#include "launcher/command_line.h"

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  return static_cast<int>(
      crosswalk::guarded("crosswalk", [&] { return crosswalk::launcher_main(arguments); }));
}
