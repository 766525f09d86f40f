// Commands that belong to a sibling program: `crosswalk rate ...` becomes `recorder rate ...`.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace crosswalk {

struct Handover {
  std::string_view command;
  std::string_view program;
  std::string_view purpose;
};

/// The commands handed over, in the order of the help text.
std::span<const Handover> handovers();
/// The program that carries out `command` with these further arguments; empty when it is our own.
std::string_view program_for(std::string_view command, const std::vector<std::string>& arguments);
/// A program that stands beside this executable; throws UserError when it was not built.
std::filesystem::path sibling_program(std::string_view name);
/// Replaces this process by `program` with the arguments, unchanged. Returns only by UserError.
[[noreturn]] void hand_over(const std::filesystem::path& program,
                            const std::vector<std::string>& arguments);

}  // namespace crosswalk
