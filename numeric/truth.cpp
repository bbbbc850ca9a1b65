#include "numeric/truth.h"

#include "numeric/truth_elementary.h"

namespace etalon {
namespace {

using Unary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
Truth apply(Unary function, const Truth& a) {
    Truth r;
    function(r.get(), a.get(), MPFR_RNDN);
    return r;
}
using Binary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);
Truth apply(Binary function, const Truth& a, const Truth& b) {
    Truth r;
    function(r.get(), a.get(), b.get(), MPFR_RNDN);
    return r;
}

// MPFR keeps constants and memory for the next call of its elementary functions, for each thread: freed when that ends.
struct KeptByMpfr {
    ~KeptByMpfr() { mpfr_free_cache2(MPFR_FREE_LOCAL_CACHE); }
};
template <class F, class... Arguments>
Truth elementary(F f, const Arguments&... arguments) {
    static thread_local const KeptByMpfr kept;
    return apply(f, arguments...);
}

}  // namespace

Truth::Truth(double value) { mpfr_set_d(get(), value, MPFR_RNDN); }

mpfr_srcptr Truth::get() const {
    if (header_._mpfr_d == limbs_.data()) return &header_;
    static thread_local std::array<__mpfr_struct, kViews> views;
    static thread_local size_t next = 0;
    mpfr_ptr view = &views[next++ % kViews];
    *view = header_;
    mpfr_custom_move(view, const_cast<mp_limb_t*>(limbs_.data()));
    return view;
}

mpfr_ptr Truth::get() {
    header_._mpfr_prec = kBits;
    mpfr_custom_move(&header_, limbs_.data());
    return &header_;
}

double Truth::toDouble() const { return mpfr_get_d(get(), MPFR_RNDN); }

Truth operator+(const Truth& a, const Truth& b) { return apply(mpfr_add, a, b); }
Truth operator-(const Truth& a, const Truth& b) { return apply(mpfr_sub, a, b); }
Truth operator*(const Truth& a, const Truth& b) { return apply(mpfr_mul, a, b); }
Truth operator/(const Truth& a, const Truth& b) { return apply(mpfr_div, a, b); }
Truth operator-(const Truth& a) { return apply(mpfr_neg, a); }

bool operator<(const Truth& a, const Truth& b) { return mpfr_less_p(a.get(), b.get()) != 0; }
bool operator<=(const Truth& a, const Truth& b) { return mpfr_lessequal_p(a.get(), b.get()) != 0; }
bool operator>(const Truth& a, const Truth& b) { return mpfr_greater_p(a.get(), b.get()) != 0; }
bool operator>=(const Truth& a, const Truth& b) { return mpfr_greaterequal_p(a.get(), b.get()) != 0; }
bool operator==(const Truth& a, const Truth& b) { return mpfr_equal_p(a.get(), b.get()) != 0; }
bool operator!=(const Truth& a, const Truth& b) { return mpfr_equal_p(a.get(), b.get()) == 0; }

Truth squareRoot(const Truth& a) { return apply(mpfr_sqrt, a); }
Truth floorOf(const Truth& a) {
    Truth r;
    mpfr_floor(r.get(), a.get());
    return r;
}
int32_t toInteger(const Truth& a) { return static_cast<int32_t>(mpfr_get_si(a.get(), MPFR_RNDZ)); }

Truth ElementaryFunctions<Truth>::atan2Of(const Truth& y, const Truth& x) {
    // A sum with +0 turns -0 into +0.
    return elementary(mpfr_atan2, y + Truth(0.0), x + Truth(0.0));
}
Truth ElementaryFunctions<Truth>::powOf(const Truth& x, const Truth& y) {
    const Truth base = x + Truth(0.0);
    if (!(base < Truth(0.0) || base != base || y != y)) return elementary(mpfr_pow, base, y);
    Truth r;
    mpfr_set_nan(r.get());
    return r;
}
Truth ElementaryFunctions<Truth>::sinOf(const Truth& x) { return elementary(mpfr_sin, x); }
Truth ElementaryFunctions<Truth>::cosOf(const Truth& x) { return elementary(mpfr_cos, x); }

}  // namespace etalon
