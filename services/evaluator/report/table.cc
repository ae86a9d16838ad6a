#include "evaluator/report/table.h"

#include <algorithm>

#include <fmt/format.h>

namespace lcmslam::report {
namespace {

std::string Row(const std::vector<std::string>& cells, const char* tag, size_t text_columns,
                bool begins_group = false) {
  std::string html = begins_group ? "<tr class=\"group\">" : "<tr>";
  for (size_t i = 0; i < cells.size(); ++i) {
    html += fmt::format("<{}{}>{}</{}>", tag, i < text_columns ? "" : " class=\"number\"", EscapeHtml(cells[i]), tag);
  }
  return html + "</tr>\n";
}

// Quoted where it holds what means something in CSV.
std::string CsvCell(const std::string& cell) {
  if (cell.find_first_of(",\"\n") == std::string::npos) return cell;
  std::string quoted = "\"";
  for (const char c : cell) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string CsvRow(const std::vector<std::string>& cells) {
  std::string line;
  for (size_t i = 0; i < cells.size(); ++i) line += (i == 0 ? "" : ",") + CsvCell(cells[i]);
  return line + "\n";
}

}  // namespace

std::string ToHtml(const Table& table) {
  std::string html = "<div class=\"scroll\"><table>\n";
  html += fmt::format("<caption>{}</caption>\n", EscapeHtml(table.caption));
  html += "<thead>" + Row(table.header, "th", table.text_columns) + "</thead>\n<tbody>\n";
  const std::string* group = nullptr;  // rows with the same first cell belong together
  for (const auto& row : table.rows) {
    html += Row(row, "td", table.text_columns, group != nullptr && *group != row.front());
    group = &row.front();
  }
  return html + "</tbody></table></div>\n";
}

std::string ToCsv(const Table& table) {
  std::string csv = CsvRow(table.header);
  for (const auto& row : table.rows) csv += CsvRow(row);
  return csv;
}

std::string ToText(const Table& table) {
  std::vector<size_t> widths(table.header.size());
  const auto widen = [&](const std::vector<std::string>& cells) {
    for (size_t i = 0; i < cells.size(); ++i) widths[i] = std::max(widths[i], cells[i].size());
  };
  widen(table.header);
  for (const auto& row : table.rows) widen(row);
  std::string text = table.caption + "\n";
  const auto print = [&](const std::vector<std::string>& cells) {
    std::string line;
    for (size_t i = 0; i < cells.size(); ++i) {
      line += i < table.text_columns ? fmt::format("{:<{}}  ", cells[i], widths[i])
                                     : fmt::format("{:>{}}  ", cells[i], widths[i]);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  };
  print(table.header);
  for (const auto& row : table.rows) print(row);
  return text;
}

std::string EscapeHtml(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

}  // namespace lcmslam::report
