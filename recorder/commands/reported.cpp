#include <cstdio>
#include <exception>

#include <fmt/format.h>

#include "common/error_object.h"
#include "recorder/commands/commands.h"

namespace crosswalk::recording {

namespace {

ExitCode fail(OutputForm form, std::string_view code, const std::string& message) {
  if (form == OutputForm::Json) {
    fmt::print("{}\n", error_object(code, message));
  } else {
    fmt::print(stderr, "error ({}): {}\n", code, message);
  }
  return ExitCode::UserError;
}

}  // namespace

ExitCode reported(OutputForm form, const std::function<ExitCode()>& command) {
  try {
    return command();
  } catch (const SignalError& error) {
    return fail(form, error.code(), error.what());
  } catch (const UserError& error) {
    return fail(form, "input", error.what());
  } catch (
      const std::filesystem::filesystem_error& error) {  // a folder that cannot be made or read
    return fail(form, "input", error.what());
  }
}

}  // namespace crosswalk::recording
