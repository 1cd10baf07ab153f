/* Start-up of a bare Cortex-M4F or M7: vector table, floating point on, memory
 * set up, then main. A fault ends the run with a message. */
#include <stdint.h>

#include "board.h"

typedef void (*handler_t)(void);

/* Set by the linker script; their addresses are the values. */
extern uint32_t board_stack_top[];
extern uint32_t board_data_load[];
extern uint32_t board_data_begin[];
extern uint32_t board_data_end[];
extern uint32_t board_bss_begin[];
extern uint32_t board_bss_end[];

int main(void);
void board_reset(void);
void board_fault(void);

void board_fault(void)
{
    board_text("FAULT\n");
    board_exit(3);
}

void board_reset(void)
{
    volatile uint32_t *const access = (volatile uint32_t *)0xE000ED88U;
    const uint32_t *from = board_data_load;
    volatile uint32_t *to; /* volatile: no call of memcpy or memset before main */
    *access = *access | (0xFU << 20); /* coprocessors 10 and 11: the FPU */
    __asm volatile("dsb\n\tisb");
    for (to = board_data_begin; to < board_data_end; ++to) {
        *to = *from;
        ++from;
    }
    for (to = board_bss_begin; to < board_bss_end; ++to) {
        *to = 0U;
    }
    board_exit(main());
}

typedef struct {
    uint32_t *stack;
    handler_t entry[15];
} vectors_t;

extern const vectors_t board_vectors;
__attribute__((section(".vectors"), used)) const vectors_t board_vectors = {
    board_stack_top,
    {board_reset, board_fault, board_fault, board_fault, board_fault, board_fault,
     0, 0, 0, 0, board_fault, board_fault, 0, board_fault, board_fault},
};
