// A run's channels as one CSV file and back: `# key: value` lines, one header whose column names
// end in their unit (`head_cog_y_mm`), decimal points, shortest digits that read back to the same
// double, an empty field for a missing sample. Nothing in it depends on the wall clock or the run's
// name: equal runs give equal bytes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "recorder/channel.h"

namespace crosswalk::recording {

/// All channels on one time base. Throws UserError when the file cannot be written.
void write_channels_csv(const std::filesystem::path& path, const std::vector<Channel>& channels,
                        const std::vector<std::pair<std::string, std::string>>& comments);

/// Reads what write_channels_csv wrote; any CSV with a uniform time column works.
std::vector<Channel> read_channels_csv(const std::filesystem::path& path);

}  // namespace crosswalk::recording
