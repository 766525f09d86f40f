// The lines of a deck and of the files it includes, one at a time, with their places.
//
// Streams in bounded memory whatever the file holds: comments ($) of any length are dropped, a data
// line longer than kMaxLine is cut and reported, a file with zero bytes is reported as binary and
// left. Line ends CR LF, trailing blanks and tabs (to the next multiple of 8) are taken care of.
// *INCLUDE nests by push(); a file that is already open above is refused as cyclic.
#pragma once

#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fe_node/deck/deck_id.h"
#include "fe_node/deck/deck_problems.h"

namespace crosswalk::fe {

class LineSource {
 public:
  static constexpr std::size_t kMaxLine = 4096;
  static constexpr std::size_t kMaxDepth = 32;

  LineSource(std::vector<std::string>& file_names, DeckProblems& problems);
  ~LineSource();

  enum class Pushed { Opened, Missing, Refused };
  /// Opens a file; the next line comes from it. Refused: cyclic or too deep, already reported.
  Pushed push_file(const std::filesystem::path& path, Source included_from);
  void push_text(std::string text, const std::string& name);

  /// The next data or keyword line of the innermost open file, or none when that file has ended.
  const std::string* peek();
  void take();
  Source place() const;  ///< of the line that peek() shows
  /// Closes the innermost file; true while another one is open.
  bool pop();
  /// Ignores the rest of the innermost file (*END).
  void end_file();
  std::size_t depth() const { return open_.size(); }
  std::filesystem::path folder() const;  ///< of the innermost file
  /// `$ crosswalk: key=value` comments met so far, without the prefix.
  std::vector<std::pair<std::string, Source>>& directives() { return directives_; }

 private:
  struct File;
  bool read_line(File& file);
  void finish_line(File& file, bool was_cut);
  std::vector<std::string>& names_;
  DeckProblems& problems_;
  std::vector<std::unique_ptr<File>> open_;
  std::vector<std::pair<std::string, Source>> directives_;
};

}  // namespace crosswalk::fe
