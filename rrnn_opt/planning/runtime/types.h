/* Data of the planner's runtime.
 *
 * NV coordinates, NJ joints, NS spheres in NB blocks of LANES, and the NQ
 * blocks of sphere pairs in NG groups are macros of the emitted section above,
 * as are the tables t_* and the functions k_* (frames, drives, distances,
 * rows, bounds).
 */
#include <signal.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define SHAPE 16
#define OPEN_MAX 4096    /* blocks within reach of a step, at most */
#define NEAR_MAX 4096    /* pairs listed for a caller, at most */
#define RADIUS_LEAST 1e-6 /* rad, no shorter look around is tried */
#define ROW_MAX 32
#define LEAST_NORM2 1e-12 /* shorter rows move nothing */
#define PASS_MAX 8       /* rows added a pass, at most */

typedef struct {
    double max_step;      /* rad, largest norm of a step */
    double min_step;      /* rad, a slide whose step falls below stalls */
    double steering;      /* m, margin kept where there is room */
    double slack;         /* m, gap that every step must prove */
    double stall_ratio;   /* a window must shorten the way to this share */
    double node_gap;      /* rad between the nodes along a slide */
    double ik_step;       /* rad, largest step of the inverse kinematics */
    double ik_share;      /* share of the goal tolerance that it must reach */
    double sweep_least;   /* rad, sweeps end when none moves u by more */
    double coin;          /* in [0, 1]: fair coin; negative: the memory cell */
    int32_t max_slide_steps;
    int32_t stall_window;
    int32_t sweeps;
    int32_t rows_per_pass;
    int32_t passes;
    int32_t max_roots;
    int32_t ik_steps;
    int32_t ik_tries;     /* postures tried before the search starts */
    int32_t edge;         /* power that draws the attraction to the limits */
    int32_t project;      /* 0: no contact rows, a slide stops at contact */
    int32_t connect;      /* 0: no connecting slide after a random one */
    int32_t drive;        /* 0: no slide straight to a tip goal */
    int32_t close_after;  /* choices after which every second has no margin */
} settings_t;

typedef struct {
    double position[3];   /* m */
    double rotation[9];   /* column by column */
    double half[3];       /* m, half edges of the region, in goal axes */
    double free[3];       /* one for the goal axis that is free, else zeros */
    double tolerance;     /* m */
    double chord;         /* 2 sin(angle tolerance / 2) */
    int32_t has_rotation;
    int32_t reserved;
} tip_goal_t;

typedef struct {
    double axes[3 * NJ], origins[3 * NJ], centers[3 * NSP + LANES];
    double tip_position[3], tip_rotation[9];
} pose_t;

typedef struct {
    int32_t sphere;       /* sphere that moves away along n */
    int32_t other;        /* obstacle, or second sphere of a self pair */
    int32_t group;        /* -1: obstacle; else group of the self pair */
    double gap;           /* m, promised margin already taken off */
    double n[3];
} near_t;

/* LANES spheres against an obstacle, or LANES sphere pairs. */
typedef struct {
    int32_t other;        /* obstacle, or -1 */
    int32_t group;        /* -1: obstacle; else group of the self pairs */
    int32_t first;        /* first sphere, or block of pairs of the tables */
    uint32_t used;        /* lanes whose rows the programme holds */
    double gap[LANES];    /* m, promised margin already taken off */
    double n[3 * LANES];
    double drift[LANES];  /* n' J u, m */
    double bound[LANES];  /* B(u), m */
    double right[LANES];  /* right-hand side of the row, m */
} block_t;

typedef struct {
    int32_t count;        /* solids; see broad.c for the tree over them */
    int32_t flat, nodes, leaf;
    const int32_t *kind, *first, *node_first, *node_size;
    const double *shape, *node_bounds;
    uint32_t *stamp, epoch;
    int32_t shortened;    /* keys are those of a shorter radius */
    double margin;        /* m, promised clearance from obstacles */
    double *key;          /* NB of a solid: out of reach while key > way */
    double *node_key;     /* the same of a node, against `farthest` */
    double pair_key[NQ + 1];
    double way[NB];       /* m, longest way in a block since the last reset */
    double farthest;      /* m, no block's is longer */
    double seen[3 * NSP]; /* centres when `way` was brought up to date */
    int32_t placed;       /* 0: not since the last reset */
    double group_way[NGP + 1]; /* m, by which pairs of a group came nearer */
    block_t *open;        /* room for OPEN_MAX */
    int32_t open_count;
    double motion[4 * NSP];   /* J u and B(u) of the spheres, block by block */
    uint32_t moved[NB], measure; /* blocks whose motion is that of the measure */
} world_t;

typedef struct {
    double q[NV];
    double tip_error;     /* to the first tip goal, m */
    int32_t parent;       /* -1: a root */
    int32_t first, count; /* way from the parent, in the pool */
    int32_t uses;         /* slides to a tip goal started here */
} node_t;

typedef struct {
    node_t *nodes;
    int32_t count, room;
} tree_t;

typedef struct {
    double distance;
    int32_t a, b;
} pair_t;

typedef struct {
    double q[NV];         /* joint target */
    const tip_goal_t *tip;/* not NULL: a tip target */
} target_t;

typedef enum { STALLED = 0, REACHED = 1, EXHAUSTED = 2 } slide_end_t;

typedef enum {
    PAUSED = 0,
    SOLVED = 1,
    BUDGET = 2,
    NO_POSTURE = 3,
    NO_MEMORY = 4,
    CANCELLED = 5
} plan_status_t;

typedef struct {
    settings_t set;
    world_t world;
    double lower[NV], upper[NV], sample_lower[NV], sample_upper[NV];
    rng_t rng;
    tree_t tree[2];       /* 0: from the start, 1: from the goals */
    double *pool;         /* waypoints, NV numbers each */
    int32_t pool_count, pool_room;
    pair_t *heap;
    int32_t heap_count, heap_room;
    tip_goal_t *tips;
    int32_t tip_count;
    double *cells;        /* activity before each exploration */
    int32_t cell_room;
    double activity;
    int64_t random, heuristic, steps, budget;
    int32_t roots, turns, random_turns, ik_failures;
    int32_t root_tries;   /* for the first goal posture */
    int64_t choices;
    double steering;      /* m, margin of the present choice */
    int32_t done[2];      /* nodes where the trees meet; done[1] = -1: none */
    double *path;
    int32_t path_count;
    int32_t out_of_memory;
    int32_t interruptible; /* Ctrl-C ends a call */
    int32_t cancelled;    /* the present call shall end */
    double deadline;      /* s, on the clock of seconds() */
} planner_t;
