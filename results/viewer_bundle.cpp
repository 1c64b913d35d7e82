#include "results/viewer_bundle.h"

// STILLHOOK_VIEWER is the folder that viewer/bundle.cmake fills before this file is compiled.
#define STILLHOOK_EMBED(name, file)                                                                            \
  asm(".section .rodata\n.global stillhook_" #name "_begin\n.global stillhook_" #name "_end\nstillhook_" #name \
      "_begin:\n.incbin \"" STILLHOOK_VIEWER "/" file "\"\nstillhook_" #name "_end:\n.byte 0\n.previous\n");   \
  extern "C" const char stillhook_##name##_begin[], stillhook_##name##_end[];

STILLHOOK_EMBED(viewer_script, "viewer.js")
STILLHOOK_EMBED(viewer_style, "viewer.css")
STILLHOOK_EMBED(viewer_hash, "viewer.hash")
STILLHOOK_EMBED(viewer_licences, "licences.txt")
STILLHOOK_EMBED(viewer_missing, "missing.txt")

namespace stillhook {
namespace {

std::string_view between(const char* begin, const char* end) { return {begin, static_cast<std::size_t>(end - begin)}; }

}  // namespace

std::string_view viewer_script() { return between(stillhook_viewer_script_begin, stillhook_viewer_script_end); }
std::string_view viewer_style() { return between(stillhook_viewer_style_begin, stillhook_viewer_style_end); }
std::string_view viewer_hash() { return between(stillhook_viewer_hash_begin, stillhook_viewer_hash_end); }
std::string_view viewer_licences() { return between(stillhook_viewer_licences_begin, stillhook_viewer_licences_end); }
std::string_view viewer_missing() { return between(stillhook_viewer_missing_begin, stillhook_viewer_missing_end); }

}  // namespace stillhook
