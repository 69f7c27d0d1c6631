// Tables as comma-separated text (RFC 4180, with \n line ends as everywhere in this project).
#pragma once

#include <string>
#include <vector>

namespace knotlight {

// One line with its end. Fields that hold a comma, a quote or a line break are quoted.
std::string csv_line(const std::vector<std::string>& fields);

std::string csv_text(const std::vector<std::string>& header,
                     const std::vector<std::vector<std::string>>& rows);

// The fields of every row of a file, the header's too. Throws InputError if it cannot be read or
// ends within quotes.
std::vector<std::vector<std::string>> read_csv(const std::string& path);

// The shortest text that reads back as the same number; "nan" and "inf" where there is none.
std::string csv_number(double value);

}  // namespace knotlight
