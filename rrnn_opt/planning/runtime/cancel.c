/* A deadline, and Ctrl-C: noticed within a few steps, also in the middle of a slide.
 *
 * A slide among very many obstacles takes a second; a caller that asks for an end
 * must not wait for it.  While a call is watched, Ctrl-C is noted here and raised
 * again when the call returns, so that the caller's own handler sees it. */

#define POLL_STEPS 4      /* steps of a slide between two looks */
#define NEVER 1e300       /* s */

static volatile sig_atomic_t interrupt_seen;

static void note_interrupt(int number)
{
    (void)number;
    interrupt_seen = 1;
}

typedef struct {
    struct sigaction before;
    int watching;
} watch_t;

/* Only one thread of a process may watch; a process that ignores Ctrl-C goes on
 * ignoring it. */
static void watch_begin(watch_t *watch, const planner_t *planner)
{
    struct sigaction noted;
    memset(&noted, 0, sizeof noted);
    noted.sa_handler = note_interrupt;
    watch->watching = planner->interruptible && !sigaction(SIGINT, NULL, &watch->before) &&
                      watch->before.sa_handler != SIG_IGN &&
                      !sigaction(SIGINT, &noted, NULL);
}

static void watch_end(const watch_t *watch)
{
    if (!watch->watching) {
        return;
    }
    sigaction(SIGINT, &watch->before, NULL);
    if (interrupt_seen) {
        interrupt_seen = 0;
        raise(SIGINT);
    }
}

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Shall the call end?  Nothing that it finds afterwards may be used. */
static int cancelled(planner_t *planner)
{
    if (!planner->cancelled) {
        planner->cancelled = interrupt_seen || seconds() > planner->deadline;
    }
    return planner->cancelled;
}
