#include "common/checkpoint.h"

#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <unistd.h>

#include "common/error.h"

namespace crosswalk {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kMagic = 0x31504B4357535243ULL;  // "CRSWCKP1"

struct PartHeader {
  std::uint64_t magic = kMagic;
  std::int64_t protocol = kProtocolVersion;
  std::int64_t role = 0, window = 0, last_seq = 0, n_records = 0, size = 0;
  std::uint64_t digest = 0;
};

fs::path part_path(const fs::path& checkpoints, Role role, std::int64_t window) {
  return checkpoints / std::to_string(window) / (std::string(role_name(role)) + ".state");
}

std::uint64_t digest_of(const std::vector<std::byte>& bytes) {
  return fnv1a({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void write_file(const fs::path& path, const std::string& content) {
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  const fs::path aside = path.string() + ".part";
  std::FILE* out = std::fopen(aside.c_str(), "wb");
  // On the disk before it gets its name, should the machine die.
  bool is_written = out != nullptr &&
                    std::fwrite(content.data(), 1, content.size(), out) == content.size() &&
                    std::fflush(out) == 0 && fsync(fileno(out)) == 0;
  if (out != nullptr) is_written = std::fclose(out) == 0 && is_written;
  if (!is_written) {
    throw ProtocolError(
        ExitCode::CheckpointMismatch,
        fmt::format("{}: cannot write the checkpoint; is the disk full?", path.string()));
  }
  fs::rename(aside, path);
}

std::string read_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    throw ProtocolError(ExitCode::CheckpointMismatch,
                        fmt::format("{}: no such checkpoint file", path.string()));
  }
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

void write_part(const fs::path& checkpoints, Role role, const CheckpointPart& part) {
  const PartHeader header{.role = static_cast<int>(role),
                          .window = part.window,
                          .last_seq = part.last_seq,
                          .n_records = part.n_records,
                          .size = static_cast<std::int64_t>(part.state.size()),
                          .digest = digest_of(part.state)};
  std::string content(reinterpret_cast<const char*>(&header), sizeof header);
  content.append(reinterpret_cast<const char*>(part.state.data()), part.state.size());
  write_file(part_path(checkpoints, role, part.window), content);
}

CheckpointPart read_part(const fs::path& checkpoints, Role role, std::int64_t window) {
  const fs::path path = part_path(checkpoints, role, window);
  const std::string content = read_file(path);
  PartHeader header;
  const auto refuse = [&](const std::string& why) {
    throw ProtocolError(ExitCode::CheckpointMismatch, fmt::format("{}: {}", path.string(), why));
  };
  if (content.size() < sizeof header) refuse("truncated");
  std::memcpy(&header, content.data(), sizeof header);
  if (header.magic != kMagic) refuse("not a checkpoint");
  if (header.protocol != kProtocolVersion) {
    refuse(fmt::format("written by protocol {}, this is {}", header.protocol, kProtocolVersion));
  }
  if (header.role != static_cast<int>(role) || header.window != window)
    refuse("of another role or window");
  if (header.size != static_cast<std::int64_t>(content.size() - sizeof header)) refuse("truncated");
  CheckpointPart part{header.window, header.last_seq, header.n_records, {}};
  part.state.resize(static_cast<std::size_t>(header.size));
  std::memcpy(part.state.data(), content.data() + sizeof header, part.state.size());
  if (digest_of(part.state) != header.digest)
    refuse("damaged: its digest does not fit its content");
  return part;
}

void commit_checkpoint(const fs::path& checkpoints, std::int64_t window) {
  write_file(checkpoints / "latest.json", fmt::format("{{\"window\": {}}}\n", window));
  for (const auto& entry : fs::directory_iterator(checkpoints)) {
    if (entry.is_directory() && entry.path().filename() != std::to_string(window)) {
      std::error_code ignored;  // an old checkpoint that stays does no harm
      fs::remove_all(entry.path(), ignored);
    }
  }
}

std::optional<std::int64_t> latest_checkpoint(const fs::path& checkpoints) {
  const fs::path path = checkpoints / "latest.json";
  if (!fs::exists(path)) return std::nullopt;
  const std::string content = read_file(path);
  std::int64_t window = -1;
  const std::size_t colon = content.find(':');
  if (colon != std::string::npos) window = std::strtoll(content.c_str() + colon + 1, nullptr, 10);
  if (window < 0) {
    throw ProtocolError(ExitCode::CheckpointMismatch,
                        fmt::format("{}: names no window", path.string()));
  }
  return window;
}

std::int64_t checkpoint_to_resume(const fs::path& checkpoints) {
  const auto window = latest_checkpoint(checkpoints);
  if (!window) {
    throw UserError(
        {{checkpoints.string()},
         "--resume",
         "a complete checkpoint",
         "none",
         "start the run anew; [coupling] checkpoint_every_ms sets how often one is written"});
  }
  return *window;
}

}  // namespace crosswalk
