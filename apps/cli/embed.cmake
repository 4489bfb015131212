# Turns the page's template into C++: cmake -DINPUT=page.html -DOUTPUT=page.cpp -P embed.cmake
# As numbers and not as a string literal, for compilers limit the length of those.
file(READ "${INPUT}" text)
string(FIND "${text}" "/*TAMIAS_REPLAY_DATA*/" place)
if(place EQUAL -1)
    message(FATAL_ERROR "${INPUT} has no place for the data: /*TAMIAS_REPLAY_DATA*/")
endif()
file(READ "${INPUT}" bytes HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," numbers "${bytes}")
string(REGEX REPLACE "(.................................................................................,)" "\\1\n" numbers "${numbers}")
file(WRITE "${OUTPUT}" "// Made from replay.html by embed.cmake.
#include \"replay_page.hpp\"

namespace tamias2d::cli {

static constexpr unsigned char kPage[] = {
${numbers}
};

std::string_view replayPage() noexcept
{
    return {reinterpret_cast<const char*>(kPage), sizeof kPage};
}

}  // namespace tamias2d::cli
")
