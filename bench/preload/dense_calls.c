/* Seconds of a program in dense routines of BLAS and LAPACK, by the order of what they work on: to be loaded before the
 * program (LD_PRELOAD). At the end, a line a routine and power of two into the file that DENSE_CALLS names: routine, least
 * order of the calls, calls, processor seconds. The order of a product is its smallest dimension. One thread. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { bins = 32, most = 16 };
struct routine { const char *name; void *call; double seconds[bins]; long calls[bins]; };
static struct routine routines[most];
static int n_routines;

static struct routine *found(const char *name)
{
    struct routine *new = &routines[n_routines++];
    new->name = name;
    new->call = dlsym(RTLD_NEXT, name);
    return new;
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return t.tv_sec + 1e-9*t.tv_nsec;
}

static int least(int a, int b) { return a < b ? a : b; }

static void note(struct routine *r, int order, double seconds)
{
    int k = 0;
    while (order > 1 && k < bins - 1) { order /= 2; k++; }
    r->seconds[k] += seconds;
    r->calls[k]++;
}

__attribute__((destructor)) static void tell(void)
{
    const char *path = getenv("DENSE_CALLS");
    FILE *file = path ? fopen(path, "w") : NULL;
    if (!file) return;
    for (int i = 0; i < n_routines; i++)
        for (int k = 0; k < bins; k++)
            if (routines[i].calls[k])
                fprintf(file, "%s %ld %ld %.6f\n", routines[i].name, 1L << k, routines[i].calls[k], routines[i].seconds[k]);
    fclose(file);
}

/* Arguments of all routines come by address; the lengths of texts, which follow them, are one each and not looked at */
#define WRAP(name, order, parameters, arguments) \
    void name parameters \
    { \
        static struct routine *r; \
        if (!r) r = found(#name); \
        double start = now(); \
        ((void (*) parameters)r->call) arguments; \
        note(r, order, now() - start); \
    }
typedef void *p;
typedef int *pi;
typedef long l;

WRAP(dgemm_, least(*m, least(*n, *k)), (p ta, p tb, pi m, pi n, pi k, p al, p a, p la, p b, p lb, p be, p c, p lc, l x, l y),
     (ta, tb, m, n, k, al, a, la, b, lb, be, c, lc, x, y))
WRAP(dsyrk_, least(*n, *k), (p u, p t, pi n, pi k, p al, p a, p la, p be, p c, p lc, l x, l y), (u, t, n, k, al, a, la, be, c, lc, x, y))
WRAP(dtrsm_, least(*m, *n), (p s, p u, p t, p d, pi m, pi n, p al, p a, p la, p b, p lb, l x, l y, l z, l w),
     (s, u, t, d, m, n, al, a, la, b, lb, x, y, z, w))
WRAP(dpotrf_, *n, (p u, pi n, p a, p la, p info, l x), (u, n, a, la, info, x))
WRAP(dpotri_, *n, (p u, pi n, p a, p la, p info, l x), (u, n, a, la, info, x))
WRAP(dgemv_, least(*m, *n), (p t, pi m, pi n, p al, p a, p la, p x, p ix, p be, p y, p iy, l z), (t, m, n, al, a, la, x, ix, be, y, iy, z))
WRAP(ssymv_, *n, (p u, pi n, p al, p a, p la, p x, p ix, p be, p y, p iy, l z), (u, n, al, a, la, x, ix, be, y, iy, z))
WRAP(dgetrf_, least(*m, *n), (pi m, pi n, p a, p la, p v, p info), (m, n, a, la, v, info))
WRAP(dgetri_, *n, (pi n, p a, p la, p v, p w, p lw, p info), (n, a, la, v, w, lw, info))
WRAP(dsyevd_, *n, (p j, p u, pi n, p a, p la, p v, p w, p lw, p i, p li, p info, l x, l y), (j, u, n, a, la, v, w, lw, i, li, info, x, y))
WRAP(dgesvd_, least(*m, *n), (p j, p k, pi m, pi n, p a, p la, p s, p u, p lu, p v, p lv, p w, p lw, p info, l x, l y),
     (j, k, m, n, a, la, s, u, lu, v, lv, w, lw, info, x, y))
WRAP(dgelsy_, least(*m, *n), (pi m, pi n, p o, p a, p la, p b, p lb, p v, p c, p k, p w, p lw, p info),
     (m, n, o, a, la, b, lb, v, c, k, w, lw, info))
