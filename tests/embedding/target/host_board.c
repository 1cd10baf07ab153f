/* The board of a host: files and text of the C library; nothing is counted. */
#include <stdio.h>

#include "board.h"

static FILE *files[4];

void board_text(const char *text)
{
    (void)fputs(text, stdout);
}

void board_number(uint32_t value)
{
    (void)printf("%lu", (unsigned long)value);
}

int board_open(const char *name, const char *mode)
{
    int k = 0;
    while ((k < 3) && (files[k] != NULL)) {
        ++k;
    }
    files[k] = fopen(name, mode);
    return (files[k] == NULL) ? -1 : k;
}

int board_read(int file, void *bytes, size_t count)
{
    return (fread(bytes, 1U, count, files[file]) == count) ? 1 : 0;
}

int board_write(int file, const void *bytes, size_t count)
{
    return (fwrite(bytes, 1U, count, files[file]) == count) ? 1 : 0;
}

void board_close(int file)
{
    (void)fclose(files[file]);
    files[file] = NULL;
}

void board_count_begin(void)
{
}

uint32_t board_count(void)
{
    return 0U;
}
