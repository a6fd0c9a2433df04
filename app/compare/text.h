// Small text helpers of the comparison's files and options.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace pssmlt::compare {

std::string trimmed(const std::string& text);  // without blanks at both ends
// Parts between separators, empty ones too; outside of parentheses only.
std::vector<std::string> split(const std::string& text, char separator);
std::string join(const std::vector<std::string>& parts, const std::string& separator);
// Lines with their numbers from 1, without comments ("#" to the end), blanks around, empty lines.
// Throws Error if the file cannot be read.
std::vector<std::pair<int, std::string>> read_lines(const std::string& file);
// For file names and identifiers: what is not a letter, digit, '-' or '_' becomes '-'.
std::string plain_name(const std::string& text);
// Replaces the file atomically: whoever is killed meanwhile leaves the old one or the new one.
// Throws Failure.
void write_file(const std::string& path, const std::string& content);
// Throws Error if the file cannot be read.
std::string read_file(const std::string& path);

}  // namespace pssmlt::compare
