// *DEFINE_ cards: curves, tables, coordinate systems, vectors, boxes, transformations.
#include "fe_node/deck/keyword_table.h"

namespace crosswalk::fe {

namespace {

constexpr int kPointWidth = 20;

void cards(CardIo& io, DeckCurve& curve) {
  io.card();
  io.id("LCID", curve.id);
  io.integer("SIDR", curve.stress_initialisation);
  io.real_or("SFA", curve.x_scale, 1);
  io.real_or("SFO", curve.y_scale, 1);
  io.real("OFFA", curve.x_offset);
  io.real("OFFO", curve.y_offset);
  io.integer("DATTYP", curve.data_type);
  io.integer("LCINT", curve.internal_points);
  io.rows(curve.points, [&io](std::pair<double, double>& point) {
    io.card();
    io.real("A1", point.first, kPointWidth);
    io.real("O1", point.second, kPointWidth);
  });
}

/// A table without curve numbers takes the curves that follow it in the deck.
void complete_table(Deck& deck, DeckId curve) {
  if (deck.tables.empty()) return;
  DeckTable& table = deck.tables.back();
  for (DeckId& id : table.curves) {
    if (id.given()) continue;
    id = curve;
    return;
  }
}

void read_curve(KeywordBlock& block) {
  DeckCurve curve;
  curve.source = block.io.keyword_source();
  block.read_title(curve.title);
  cards(block.io, curve);
  complete_table(block.deck, curve.id);
  block.deck.curves.push_back(std::move(curve));
}

void cards(CardIo& io, CurveFunction& function) {
  io.card();
  io.id("LCID", function.id);
  io.integer("SIDR", function.stress_initialisation);
  if (io.is_reading()) {
    while (io.has_content()) io.raw_line(function.expression.emplace_back());
    return;
  }
  for (std::string& line : function.expression) io.raw_line(line);
}

void read_curve_function(KeywordBlock& block) {
  CurveFunction function;
  function.source = block.io.keyword_source();
  block.read_title(function.title);
  cards(block.io, function);
  block.deck.curve_functions.push_back(std::move(function));
}

struct TableRow {
  double value = 0;
  DeckId curve;
};

void cards(CardIo& io, DeckTable& table) {
  io.card();
  io.id("TBID", table.id);
  io.real_or("SFA", table.scale, 1);
  io.real("OFFA", table.offset);
  std::vector<TableRow> rows;
  for (std::size_t i = 0; i < table.values.size(); ++i)
    rows.push_back({.value = table.values[i], .curve = table.curves[i]});
  io.rows(rows, [&io](TableRow& row) {
    io.card();
    io.real("VALUE", row.value, kPointWidth);
    io.id("LCID", row.curve, kPointWidth);
  });
  if (!io.is_reading()) return;
  for (const TableRow& row : rows) {
    table.values.push_back(row.value);
    table.curves.push_back(row.curve);
  }
}

void read_table(KeywordBlock& block) {
  DeckTable table;
  table.source = block.io.keyword_source();
  block.read_title(table.title);
  cards(block.io, table);
  block.deck.tables.push_back(std::move(table));
}

void cards(CardIo& io, CoordinateNodes& axes) {
  io.card();
  io.id("CID", axes.id);
  io.id("N1", axes.nodes[0]);
  io.id("N2", axes.nodes[1]);
  io.id("N3", axes.nodes[2]);
  io.integer("FLAG", axes.is_updated);
  io.text("DIR", axes.axis);
  if (axes.axis.empty()) axes.axis.assign(1, 'X');
}

void system_cards(CardIo& io, CoordinateSystem& axes) {
  io.card();
  io.id("CID", axes.id);
  io.vec3({"XO", "YO", "ZO"}, axes.origin);
  io.vec3({"XL", "YL", "ZL"}, axes.x_point);
  io.id("CIDL", axes.axes);
  io.card();
  io.vec3({"XP", "YP", "ZP"}, axes.xy_point);
}

void vector_cards(CardIo& io, CoordinateSystem& axes) {
  io.card();
  io.id("CID", axes.id);
  io.vec3({"XX", "YX", "ZX"}, axes.x_point);
  io.vec3({"XV", "YV", "ZV"}, axes.xy_point);
  io.id("NID", axes.node);
}

void cards(CardIo& io, CoordinateSystem& axes) {
  axes.is_vector_form ? vector_cards(io, axes) : system_cards(io, axes);
}

void cards(CardIo& io, DefinedVector& vector) {
  io.card();
  io.id("VID", vector.id);
  io.vec3({"XT", "YT", "ZT"}, vector.tail);
  io.vec3({"XH", "YH", "ZH"}, vector.head);
  io.id("CID", vector.axes);
}

void cards(CardIo& io, SpringOrientation& orientation) {
  io.card();
  io.id("VID", orientation.id);
  io.integer("IOP", orientation.option);
  io.vec3({"XT", "YT", "ZT"}, orientation.direction);
  io.id("NID1", orientation.nodes[0]);
  io.id("NID2", orientation.nodes[1]);
}

void cards(CardIo& io, DefinedBox& box) {
  io.card();
  io.id("BOXID", box.id);
  for (int i = 0; i < 3; ++i) {
    constexpr const char* kLow[] = {"XMN", "YMN", "ZMN"};
    constexpr const char* kHigh[] = {"XMX", "YMX", "ZMX"};
    io.real(kLow[i], box.low[i]);
    io.real(kHigh[i], box.high[i]);
  }
}

void cards(CardIo& io, Transformation& transformation) {
  io.card();
  io.id("TRANID", transformation.id);
  io.rows(transformation.rows, [&io](std::pair<std::string, std::array<double, 7>>& row) {
    io.card();
    io.text("OPTION", row.first);
    io.reals("A", row.second);
  });
}

template <auto Member>
void read_plain(KeywordBlock& block) {
  read_records(block, block.deck.*Member, [&block](CardIo& io, auto& record) {
    block.read_title(record.title);
    cards(io, record);
  });
}

void read_coordinate_vectors(KeywordBlock& block) {
  read_records(block, block.deck.coordinate_systems, [&block](CardIo& io, CoordinateSystem& axes) {
    block.read_title(axes.title);
    axes.is_vector_form = true;
    cards(io, axes);
  });
}

const std::vector<KeywordEntry>& entries() {
  static const std::vector<KeywordEntry> kEntries{
      {"DEFINE_CURVE", {"TITLE"}, read_curve},
      {"DEFINE_CURVE_FUNCTION", {"TITLE"}, read_curve_function},
      {"DEFINE_TABLE", {"TITLE"}, read_table},
      {"DEFINE_TABLE_2D", {"TITLE"}, read_table},
      {"DEFINE_COORDINATE_NODES", {"TITLE"}, read_plain<&Deck::coordinate_nodes>},
      {"DEFINE_COORDINATE_SYSTEM", {"TITLE"}, read_plain<&Deck::coordinate_systems>},
      {"DEFINE_COORDINATE_VECTOR", {"TITLE"}, read_coordinate_vectors},
      {"DEFINE_VECTOR", {"TITLE"}, read_plain<&Deck::vectors>},
      {"DEFINE_SD_ORIENTATION", {"TITLE"}, read_plain<&Deck::spring_orientations>},
      {"DEFINE_BOX", {"TITLE"}, read_plain<&Deck::boxes>},
      {"DEFINE_TRANSFORMATION", {"TITLE"}, read_plain<&Deck::transformations>},
  };
  return kEntries;
}

template <class Record>
void write_each(CardWriter& out, const char* keyword, const std::vector<Record>& records) {
  for (Record record : records) {
    out.keyword_with_title(keyword, record.title);
    cards(out, record);
  }
}

}  // namespace

std::span<const KeywordEntry> table_keywords() { return entries(); }

void write_tables(CardWriter& out, const Deck& deck) {
  write_each(out, "DEFINE_TABLE_2D", deck.tables);
  write_each(out, "DEFINE_CURVE", deck.curves);
  write_each(out, "DEFINE_CURVE_FUNCTION", deck.curve_functions);
  write_each(out, "DEFINE_COORDINATE_NODES", deck.coordinate_nodes);
  for (CoordinateSystem axes : deck.coordinate_systems) {
    out.keyword_with_title(
        axes.is_vector_form ? "DEFINE_COORDINATE_VECTOR" : "DEFINE_COORDINATE_SYSTEM", axes.title);
    cards(out, axes);
  }
  write_each(out, "DEFINE_VECTOR", deck.vectors);
  write_each(out, "DEFINE_SD_ORIENTATION", deck.spring_orientations);
  write_each(out, "DEFINE_BOX", deck.boxes);
  write_each(out, "DEFINE_TRANSFORMATION", deck.transformations);
}

}  // namespace crosswalk::fe
