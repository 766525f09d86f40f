#include "fe_node/deck/line_source.h"

#include <array>
#include <cstring>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "fe_node/deck/number.h"

namespace crosswalk::fe {

namespace {
constexpr std::size_t kBufferSize = 1 << 16;
constexpr std::string_view kDirective = "$ crosswalk:";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // of UTF-8
constexpr std::size_t kMaxDirectives = 100;
}  // namespace

struct LineSource::File {
  std::unique_ptr<std::istream> stream;
  std::filesystem::path path;  ///< canonical; empty for a text
  std::filesystem::path folder;
  std::int32_t index = 0;
  std::int32_t line_number = 0;
  std::vector<char> buffer = std::vector<char>(kBufferSize);
  std::size_t at = 0, filled = 0;
  std::string line;
  bool has_line = false, has_ended = false;
};

LineSource::LineSource(std::vector<std::string>& file_names, DeckProblems& problems)
    : names_(file_names), problems_(problems) {}

LineSource::~LineSource() = default;

LineSource::Pushed LineSource::push_file(const std::filesystem::path& path, Source included_from) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path canonical = fs::canonical(path, error);
  if (error || !fs::is_regular_file(canonical, error)) return Pushed::Missing;
  const auto refuse = [&](const std::string& found, const std::string& hint) {
    problems_.errors.add(
        Place{names_[static_cast<std::size_t>(included_from.file)], included_from.line, 0},
        "*INCLUDE", {}, found, hint);
    return Pushed::Refused;
  };
  for (const auto& file : open_)
    if (!file->path.empty() && file->path == canonical)
      return refuse(fmt::format("a cycle: {} includes itself", canonical.string()),
                    "remove one of the *INCLUDE lines");
  if (open_.size() >= kMaxDepth)
    return refuse(fmt::format("includes nested deeper than {}", kMaxDepth), "");
  auto stream = std::make_unique<std::ifstream>(canonical, std::ios::binary);
  if (!*stream) return Pushed::Missing;
  auto file = std::make_unique<File>();
  file->stream = std::move(stream);
  file->path = canonical;
  file->folder = path.parent_path();
  file->index = static_cast<std::int32_t>(names_.size());
  names_.push_back(path.string());
  open_.push_back(std::move(file));
  return Pushed::Opened;
}

void LineSource::push_text(std::string text, const std::string& name) {
  auto file = std::make_unique<File>();
  file->stream = std::make_unique<std::istringstream>(std::move(text));
  file->index = static_cast<std::int32_t>(names_.size());
  names_.push_back(name);
  open_.push_back(std::move(file));
}

const std::string* LineSource::peek() {
  File& file = *open_.back();
  while (!file.has_line && !file.has_ended) file.has_line = read_line(file);
  return file.has_line ? &file.line : nullptr;
}

void LineSource::take() { open_.back()->has_line = false; }

Source LineSource::place() const {
  return {.file = open_.back()->index, .line = open_.back()->line_number};
}

bool LineSource::pop() {
  open_.pop_back();
  return !open_.empty();
}

void LineSource::end_file() {
  open_.back()->has_ended = true;
  open_.back()->has_line = false;
}

std::filesystem::path LineSource::folder() const { return open_.back()->folder; }

/// Reads to the next line end; true when the line is data or a keyword.
bool LineSource::read_line(File& file) {
  file.line.clear();
  bool was_cut = false, has_any = false;
  while (true) {
    if (file.at == file.filled) {
      file.stream->read(file.buffer.data(), static_cast<std::streamsize>(kBufferSize));
      file.filled = static_cast<std::size_t>(file.stream->gcount());
      file.at = 0;
      if (file.filled == 0) {
        file.has_ended = true;
        if (!has_any) return false;
        break;
      }
    }
    has_any = true;
    const char* begin = file.buffer.data() + file.at;
    const std::size_t left = file.filled - file.at;
    const void* end = std::memchr(begin, '\n', left);
    const std::size_t taken =
        end != nullptr ? static_cast<std::size_t>(static_cast<const char*>(end) - begin) : left;
    const std::size_t room = kMaxLine - file.line.size();
    file.line.append(begin, std::min(taken, room));
    was_cut = was_cut || taken > room;
    file.at += taken + (end != nullptr ? 1 : 0);
    if (end != nullptr) break;
  }
  ++file.line_number;
  if (file.line_number == 1 && file.line.starts_with(kByteOrderMark))
    file.line.erase(0, kByteOrderMark.size());
  if (file.line.find('\0') != std::string::npos) {
    problems_.errors.add(Place{names_[static_cast<std::size_t>(file.index)], file.line_number, 0},
                         "file", "text", "binary data",
                         "this is not a keyword file; the rest of it was not read");
    file.has_ended = true;
    return false;
  }
  if (!file.line.empty() && file.line.front() == '$') {
    if (file.line.starts_with(kDirective) && directives_.size() < kMaxDirectives)
      directives_.emplace_back(trimmed(std::string_view(file.line).substr(kDirective.size())),
                               Source{.file = file.index, .line = file.line_number});
    return false;
  }
  finish_line(file, was_cut);
  return true;
}

void LineSource::finish_line(File& file, bool was_cut) {
  const std::size_t last = file.line.find_last_not_of(" \t\r");
  file.line.erase(last == std::string::npos ? 0 : last + 1);
  if (was_cut && file.line.size() >= kMaxLine / 2)
    problems_.errors.add(Place{names_[static_cast<std::size_t>(file.index)], file.line_number, 0},
                         "line", fmt::format("at most {} characters", kMaxLine), "a longer one",
                         "what stands beyond was not read");
  if (file.line.find('\t') == std::string::npos) return;
  std::string expanded;
  for (const char c : file.line) {
    if (c == '\t') {
      expanded.append(8 - expanded.size() % 8, ' ');
    } else {
      expanded += c;
    }
  }
  file.line = std::move(expanded);
}

}  // namespace crosswalk::fe
