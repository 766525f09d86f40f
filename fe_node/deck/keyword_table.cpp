#include "fe_node/deck/keyword_table.h"

#include <algorithm>

namespace crosswalk::fe {

bool KeywordBlock::has(std::string_view option) const {
  return std::find(options.begin(), options.end(), option) != options.end();
}

void KeywordBlock::read_title(std::string& title) {
  if (has("TITLE")) io.line("TITLE", title);
}

void KeywordBlock::read_id(DeckId& id, std::string& title) {
  if (has("ID") || has("TITLE")) io.id_and_title(id, title);
}

}  // namespace crosswalk::fe
