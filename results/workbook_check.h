#pragma once

#include <string>

namespace stillhook {

/// What is wrong with an Excel workbook as it lies on the disk: empty if every sheet in it is whole. The library that
/// writes workbooks puts the sheets together in temporary files and does not notice when the disk is full under these.
std::string workbook_fault(const std::string& path);

}  // namespace stillhook
