// SPDX-License-Identifier: MIT

// glass: a pane of glass is pulled until the crack from its notch splits it, by cgo.
//
// cgo reads peri.h itself: what is written here are an error and a callback that is a closure.
//
//	make lib && cd bindings/go && go run .
package main

/*
#cgo CFLAGS: -I${SRCDIR}/../..
#cgo LDFLAGS: -L${SRCDIR}/../../build -l:libperi.a -lgomp -lm
#include "peri.h"
#include <stdlib.h>

extern int32_t goFrame(void *user, peri_body *body);
static void watch(peri_advance_desc *run, uintptr_t handle) { run->on_frame = goFrame; run->user = (void *)handle; }
*/
import "C"

import (
	"fmt"
	"os"
	"runtime/cgo"
	"unsafe"
)

// Error is the record of the library.
type Error struct {
	Status int
	Field  string
	Index  int64
	Value  float64
	Text   string
}

func (e *Error) Error() string { return e.Text }

// must gives an id or a count, or panics with an *Error.
func must(body *C.peri_body, result C.int64_t) C.int32_t {
	if result < 0 {
		var record C.peri_error
		var text [300]C.char
		C.peri_get_error(body, &record)
		C.peri_format_error(&record, &text[0], 300)
		panic(&Error{int(record.code), C.GoString(record.field), int64(record.index), float64(record.value), C.GoString(&text[0])})
	}
	return C.int32_t(result)
}

// A frame carries a closure into the library, and its panic out.
type frame struct {
	call   func(body *C.peri_body) int
	thrown any
}

//export goFrame
func goFrame(user unsafe.Pointer, body *C.peri_body) (result C.int32_t) {
	f := cgo.Handle(user).Value().(*frame)
	defer func() {
		if f.thrown = recover(); f.thrown != nil {
			result = -1
		}
	}()
	return C.int32_t(f.call(body))
}

// advance runs; a panic of the closure stops the run and goes on from here.
func advance(body *C.peri_body, run *C.peri_advance_desc, call func(body *C.peri_body) int) {
	f := &frame{call: call}
	handle := cgo.NewHandle(f)
	defer handle.Delete()
	C.watch(run, C.uintptr_t(handle))
	result := C.peri_advance(body, run)
	if f.thrown != nil {
		panic(f.thrown)
	}
	must(body, C.int64_t(result))
}

func xy(x, y float64) *C.double { return (*C.double)(&[]float64{x, y}[0]) }

func main() {
	defer func() {
		switch e := recover().(type) {
		case nil:
		case *Error:
			fmt.Fprintln(os.Stderr, e)
			os.Exit(1)
		default:
			panic(e)
		}
	}()
	var d C.peri_body_desc
	C.peri_body_desc_init(&d)
	d.space, d.horizon = C.PERI_SPACE_PLANE_STRESS, 1.5e-3
	var glass C.peri_material_desc
	C.peri_material_desc_init(&glass, C.PERI_LAW_BOND_BASED)
	glass.young, glass.density, glass.fracture_energy = 72e9, 2440, 3.8
	var pane *C.peri_body
	if C.peri_body_create(&d, &pane, nil) < 0 {
		os.Exit(1)
	}
	defer C.peri_body_destroy(pane)
	material := must(pane, C.int64_t(C.peri_add_material(pane, &glass)))
	must(pane, C.peri_add_box(pane, material, xy(0, 0), xy(0.1, 0.04), 0.5e-3))
	must(pane, C.int64_t(C.peri_build(pane)))
	must(pane, C.peri_cut_segment(pane, C.PERI_CUT_INITIAL, xy(0, 0.02), xy(0.05, 0.02)))
	top := must(pane, C.int64_t(C.peri_select_box(pane, nil, xy(0, 0.0395), xy(0.1, 0.04))))
	bottom := must(pane, C.int64_t(C.peri_select_box(pane, nil, xy(0, 0), xy(0.1, 0.0005))))
	must(pane, C.int64_t(C.peri_apply_layer_traction(pane, top, 0.1, xy(0, 2e6), nil, nil)))
	must(pane, C.int64_t(C.peri_prescribe_velocity(pane, bottom, C.PERI_AXIS_XY, nil, nil, nil)))
	var run C.peri_advance_desc
	C.peri_advance_desc_init(&run)
	run.duration, run.frame_steps = 40e-6, 50
	frames := 0
	advance(pane, &run, func(body *C.peri_body) int { frames++; return 0 })
	var energy C.peri_energy
	must(pane, C.int64_t(C.peri_get_energy(pane, &energy)))
	fmt.Printf("%d points, %d steps, %d bonds broken\n", C.peri_point_count(pane), C.peri_step_count(pane), C.peri_broken_count(pane))
	fmt.Printf("glass.kinetic %.17g\nglass.frames %d\n", float64(energy.kinetic), frames)
}
