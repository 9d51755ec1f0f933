#pragma once

#include <cstdint>
#include <istream>
#include <string>

namespace rayshoot {

/// What of a mesh file OpenMesh's readers can be trusted with: they skip what they do not understand, so that
/// one bad line moves all the others, and some bad lines stop the program. Each of these checks a file and
/// throws InputError "name:line: reason"; those that return a text return one with the same faces and nothing
/// else.
std::string plain_obj(std::istream& in, const std::string& name);
std::string plain_off(std::istream& in, const std::string& name);
std::string plain_stl(std::istream& in, const std::string& name);
/// Check a PLY header only; numbers behind it are up to whoever reads them.
void check_ply_header(std::istream& in, const std::string& name);

/// Whether a file of `bytes` bytes is as long as a binary STL file of the triangles it declares.
bool is_binary_stl(std::istream& in, std::uintmax_t bytes);
/// Check the coordinates of a binary STL file from its beginning.
void check_binary_stl(std::istream& in, const std::string& name);

}  // namespace rayshoot
