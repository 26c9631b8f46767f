#include "src/app/lettering.h"

#include <cctype>
#include <cstdint>

namespace promenade::app {
namespace {

// Seven rows of five dots, the top row first, its left dot first.
std::uint64_t dotsOf(char c) {
  switch (std::toupper(static_cast<unsigned char>(c))) {
    case 'A':
      return 0b01110'10001'10001'11111'10001'10001'10001;
    case 'B':
      return 0b11110'10001'10001'11110'10001'10001'11110;
    case 'C':
      return 0b01110'10001'10000'10000'10000'10001'01110;
    case 'D':
      return 0b11110'10001'10001'10001'10001'10001'11110;
    case 'E':
      return 0b11111'10000'10000'11110'10000'10000'11111;
    case 'F':
      return 0b11111'10000'10000'11110'10000'10000'10000;
    case 'G':
      return 0b01110'10001'10000'10111'10001'10001'01111;
    case 'H':
      return 0b10001'10001'10001'11111'10001'10001'10001;
    case 'I':
      return 0b01110'00100'00100'00100'00100'00100'01110;
    case 'J':
      return 0b00111'00010'00010'00010'00010'10010'01100;
    case 'K':
      return 0b10001'10010'10100'11000'10100'10010'10001;
    case 'L':
      return 0b10000'10000'10000'10000'10000'10000'11111;
    case 'M':
      return 0b10001'11011'10101'10101'10001'10001'10001;
    case 'N':
      return 0b10001'11001'10101'10011'10001'10001'10001;
    case 'O':
      return 0b01110'10001'10001'10001'10001'10001'01110;
    case 'P':
      return 0b11110'10001'10001'11110'10000'10000'10000;
    case 'Q':
      return 0b01110'10001'10001'10001'10101'10010'01101;
    case 'R':
      return 0b11110'10001'10001'11110'10100'10010'10001;
    case 'S':
      return 0b01111'10000'10000'01110'00001'00001'11110;
    case 'T':
      return 0b11111'00100'00100'00100'00100'00100'00100;
    case 'U':
      return 0b10001'10001'10001'10001'10001'10001'01110;
    case 'V':
      return 0b10001'10001'10001'10001'01010'01010'00100;
    case 'W':
      return 0b10001'10001'10001'10101'10101'11011'10001;
    case 'X':
      return 0b10001'10001'01010'00100'01010'10001'10001;
    case 'Y':
      return 0b10001'10001'01010'00100'00100'00100'00100;
    case 'Z':
      return 0b11111'00001'00010'00100'01000'10000'11111;
    case '0':
      return 0b01110'10001'10011'10101'11001'10001'01110;
    case '1':
      return 0b00100'01100'00100'00100'00100'00100'01110;
    case '2':
      return 0b01110'10001'00001'00110'01000'10000'11111;
    case '3':
      return 0b11111'00010'00100'00010'00001'10001'01110;
    case '4':
      return 0b00010'00110'01010'10010'11111'00010'00010;
    case '5':
      return 0b11111'10000'11110'00001'00001'10001'01110;
    case '6':
      return 0b00110'01000'10000'11110'10001'10001'01110;
    case '7':
      return 0b11111'00001'00010'00100'01000'01000'01000;
    case '8':
      return 0b01110'10001'10001'01110'10001'10001'01110;
    case '9':
      return 0b01110'10001'10001'01111'00001'00010'01100;
    case '%':
      return 0b11001'11001'00010'00100'01000'10011'10011;
    case '.':
      return 0b00000'00000'00000'00000'00000'01100'01100;
    case ',':
      return 0b00000'00000'00000'00000'01100'00100'01000;
    case ':':
      return 0b00000'01100'01100'00000'01100'01100'00000;
    case '-':
      return 0b00000'00000'00000'11111'00000'00000'00000;
    case '+':
      return 0b00000'00100'00100'11111'00100'00100'00000;
    default:
      return 0;
  }
}

}  // namespace

int textWidth(std::string_view text) {
  return static_cast<int>(text.size()) * 6 * kDot;
}

void drawText(EncodedMap& image, int left, int top, std::string_view text) {
  for (const char c : text) {
    const std::uint64_t dots = dotsOf(c);
    for (int i = 0; i < 35; ++i) {
      if ((dots >> (34 - i) & 1) == 0) continue;
      for (int k = 0; k < kDot * kDot; ++k) {
        const int x = left + i % 5 * kDot + k % kDot;
        const int y = top + i / 5 * kDot + k / kDot;
        if (image.contains(x, y)) image(x, y) = Rgb(1.0f);
      }
    }
    left += 6 * kDot;
  }
}

}  // namespace promenade::app
