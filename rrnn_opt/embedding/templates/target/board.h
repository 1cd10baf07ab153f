/* What a test needs of a board: text out, files of the debugging host in and out,
 * a counter, and an end. Replace board.c to run on other hardware. */
#ifndef BOARD_H
#define BOARD_H

#include <stddef.h>
#include <stdint.h>

void board_text(const char *text);
void board_number(uint32_t value);      /* decimal */
void board_bits32(uint32_t value);      /* eight hexadecimal digits */
void board_bits64(uint64_t value);      /* sixteen */

/* A file of the debugging host; mode "rb" or "wb". Negative: it cannot be opened. */
int board_open(const char *name, const char *mode);
/* Whole blocks only: 1 when all bytes were moved, else 0. */
int board_read(int file, void *bytes, size_t count);
int board_write(int file, const void *bytes, size_t count);
void board_close(int file);

/* Instructions so far, modulo 2^32, exact to one, where the board can count them. */
void board_count_begin(void);
uint32_t board_count(void);

void board_exit(int status);

#endif
