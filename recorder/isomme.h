// ISO-MME multimedia exchange (ISO/TS 13499, edition 1.6): folder TEST with TEST.mme,
// Channel/TEST.chn and one file per channel, Channel/TEST.001 onwards.
//
// Header lines are "descriptor" padded to 28 characters, a colon, the value; split at the first
// colon on reading, tabs and blanks trimmed, repeated keys kept, NOVALUE for what is missing (also
// among data, read as NaN). Written with CR/LF and lines of at most 80 characters.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "recorder/channel.h"

namespace crosswalk::recording {

using MmeHeader = std::vector<std::pair<std::string, std::string>>;

struct MmeChannel {
  std::string code;          ///< 16 characters, such as D0HEADCG00VHACXA
  std::string name;          ///< text behind the code in the channel list
  std::string unit;          ///< as written: m/(s*s), rad/s, m, N, 1
  bool is_constant = false;  ///< one value without time
  std::vector<double> time;  ///< s; empty for a constant
  std::vector<double> values;
  MmeHeader header;  ///< everything the file said
};

struct MmeTest {
  std::string name;
  MmeHeader header;  ///< of the .mme file
  std::vector<MmeChannel> channels;
};

/// First value of a key; nothing when absent or NOVALUE.
std::optional<std::string> value_of(const MmeHeader& header, const std::string& key);

/// True for a folder with a .mme file.
bool is_isomme(const std::filesystem::path& folder);
/// Throws UserError naming file and line.
MmeTest read_isomme(const std::filesystem::path& folder);
void write_isomme(const std::filesystem::path& folder, const MmeTest& test);

/// The 16-character code of a channel of ours; empty when the standard has no place for it.
std::string mme_code(const std::string& channel_name);

/// A run's channels (those with a code) as a test, units converted to SI.
MmeTest mme_test(const std::string& name, const std::vector<Channel>& channels,
                 const MmeHeader& header);
/// The other way: head and car channels of a test, whatever its dummy and filter class, under our
/// names and units. Channels without a uniform time base or of other places are left out.
std::vector<Channel> channels_of(const MmeTest& test);
/// A result without time, such as HIC15.
MmeChannel mme_constant(const std::string& code, const std::string& name, double value);

}  // namespace crosswalk::recording
