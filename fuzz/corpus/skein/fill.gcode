(<format> clayforge skein </format>)
(<extruderInitialization>)
G90
G21
(<craftTypeName> extrusion </craftTypeName>)
(<decimalPlacesCarried> 3 </decimalPlacesCarried>)
(<layerHeight> 2.8 </layerHeight>)
(<firstLayerHeight> 2.8 </firstLayerHeight>)
(<nozzleDiameter> 6.0 </nozzleDiameter>)
(<eUnit> mm3 </eUnit>)
(<heaters> none </heaters>)
(<bed> rectangle 0.0 0.0 200.0 200.0 </bed>)
(<beadSection> rectangle </beadSection>)
(<infillWidth> 6.0 </infillWidth>)
(<edgeWidth> 6.0 </edgeWidth>)
(<settings>)
(<setting> carve layer_height 2.8 </setting>)
(<setting> carve first_layer_height 2.8 </setting>)
(<setting> carve bead_width 6 </setting>)
(<setting> carve bead_section "rectangle" </setting>)
(<setting> carve place "bed" </setting>)
(<setting> carve rotate [0, 0, 0] </setting>)
(<setting> carve part_gap 10 </setting>)
(<setting> carve surface "solid" </setting>)
(<setting> carve wall_beads 1 </setting>)
(<setting> carve repair true </setting>)
(<setting> carve close_gaps 10 </setting>)
(<setting> carve find_bridges true </setting>)
(<setting> bottom altitude 0 </setting>)
(<setting> bottom additional_height 0.5 </setting>)
(<setting> preface meta "" </setting>)
(<setting> preface set_positioning_to_absolute true </setting>)
(<setting> preface set_units_to_millimeters true </setting>)
(<setting> inset thin_walls "middle" </setting>)
(<setting> inset least_width 0.4 </setting>)
(<setting> inset overlap_removal_width 0 </setting>)
(<setting> inset exact_wall "neither" </setting>)
(<setting> inset bridge_width 1 </setting>)
(<setting> fill walls 2 </setting>)
(<setting> fill extra_shells_base 0 </setting>)
(<setting> fill extra_shells_alternating_solid_layer 0 </setting>)
(<setting> fill extra_shells_sparse_layer 0 </setting>)
(<setting> fill extra_shells_bridge_layer 0 </setting>)
(<setting> fill base_layers 2 </setting>)
(<setting> fill top_layers 2 </setting>)
(<setting> fill surrounding_angle 0 </setting>)
(<setting> fill diaphragm_period 100 </setting>)
(<setting> fill diaphragm_thickness 0 </setting>)
(<setting> fill density 0.2 </setting>)
(<setting> fill pattern "line" </setting>)
(<setting> fill grid_overlap 0.1 </setting>)
(<setting> fill circle_gap 0 </setting>)
(<setting> fill overlap 0 </setting>)
(<setting> fill begin_rotation 45 </setting>)
(<setting> fill begin_rotation_repeat 1 </setting>)
(<setting> fill odd_layer_extra_rotation 90 </setting>)
(<setting> fill sharpest_angle 0 </setting>)
(<setting> fill thread_sequence "loops-perimeter-infill" </setting>)
(<setting> fill first_layer_sequence "perimeter-loops-infill" </setting>)
(<setting> fill start "nearest" </setting>)
(<setting> fill seam [0, 0] </setting>)
(</settings>)
(<procedureName> carve </procedureName>)
(<procedureName> bottom </procedureName>)
(<procedureName> preface </procedureName>)
(<procedureName> inset </procedureName>)
(<procedureName> fill </procedureName>)
(</extruderInitialization>)
(<crafting>)
(<layer> 1.4 )
(<rotation> (0.707107+0.707107j) )
(<nestedRing>)
(<boundaryPerimeter>)
(<boundaryPoint> X80.0 Y80.0 Z1.4 </boundaryPoint>)
(<boundaryPoint> X120.0 Y80.0 Z1.4 </boundaryPoint>)
(<boundaryPoint> X120.0 Y120.0 Z1.4 </boundaryPoint>)
(<boundaryPoint> X80.0 Y120.0 Z1.4 </boundaryPoint>)
(</boundaryPerimeter>)
(<edge> outer )
G1 X83.0 Y83.0 Z2.8
M101
G1 X117.0 Y83.0 Z2.8
G1 X117.0 Y117.0 Z2.8
G1 X83.0 Y117.0 Z2.8
G1 X83.0 Y83.0 Z2.8
M103
(</edge>)
(<loop> outer )
G1 X89.0 Y89.0 Z2.8
M101
G1 X111.0 Y89.0 Z2.8
G1 X111.0 Y111.0 Z2.8
G1 X89.0 Y111.0 Z2.8
G1 X89.0 Y89.0 Z2.8
M103
(</loop>)
(<infill>)
G1 X104.999 Y95.0 Z2.8
M101
M108 S1.25
G1 X105.0 Y95.001 Z2.8
G1 X105.0 Y105.0 Z2.8
G1 X95.0 Y95.0 Z2.8
G1 X95.0 Y104.999 Z2.8
G1 X95.001 Y105.0 Z2.8
M103
M108 S1.0
(</infill>)
(</nestedRing>)
(</rotation>)
(</layer>)
(<layer> 4.2 )
(<rotation> (-0.707107+0.707107j) )
(<nestedRing>)
(<boundaryPerimeter>)
(<boundaryPoint> X80.0 Y80.0 Z4.2 </boundaryPoint>)
(<boundaryPoint> X120.0 Y80.0 Z4.2 </boundaryPoint>)
(<boundaryPoint> X120.0 Y120.0 Z4.2 </boundaryPoint>)
(<boundaryPoint> X80.0 Y120.0 Z4.2 </boundaryPoint>)
(</boundaryPerimeter>)
(<loop> outer )
G1 X89.0 Y111.0 Z5.6
M101
G1 X89.0 Y89.0 Z5.6
G1 X111.0 Y89.0 Z5.6
G1 X111.0 Y111.0 Z5.6
G1 X89.0 Y111.0 Z5.6
M103
(</loop>)
(<edge> outer )
G1 X83.0 Y117.0 Z5.6
M101
G1 X83.0 Y83.0 Z5.6
G1 X117.0 Y83.0 Z5.6
G1 X117.0 Y117.0 Z5.6
G1 X83.0 Y117.0 Z5.6
M103
(</edge>)
(<infill>)
G1 X95.0 Y95.001 Z5.6
M101
M108 S1.25
G1 X95.001 Y95.0 Z5.6
G1 X105.0 Y95.0 Z5.6
G1 X95.0 Y105.0 Z5.6
G1 X104.999 Y105.0 Z5.6
G1 X105.0 Y104.999 Z5.6
M103
M108 S1.0
(</infill>)
(</nestedRing>)
(</rotation>)
(</layer>)
(<layer> 7.0 )
(<rotation> (0.707107+0.707107j) )
(<nestedRing>)
(<boundaryPerimeter>)
(<boundaryPoint> X80.0 Y80.0 Z7.0 </boundaryPoint>)
(<boundaryPoint> X120.0 Y80.0 Z7.0 </boundaryPoint>)
(<boundaryPoint> X120.0 Y120.0 Z7.0 </boundaryPoint>)
(<boundaryPoint> X80.0 Y120.0 Z7.0 </boundaryPoint>)
(</boundaryPerimeter>)
(<loop> outer )
G1 X111.0 Y111.0 Z8.4
M101
G1 X89.0 Y111.0 Z8.4
G1 X89.0 Y89.0 Z8.4
G1 X111.0 Y89.0 Z8.4
G1 X111.0 Y111.0 Z8.4
M103
(</loop>)
(<edge> outer )
G1 X117.0 Y117.0 Z8.4
M101
G1 X83.0 Y117.0 Z8.4
G1 X83.0 Y83.0 Z8.4
G1 X117.0 Y83.0 Z8.4
G1 X117.0 Y117.0 Z8.4
M103
(</edge>)
(<infill>)
G1 X105.0 Y105.0 Z8.4
M101
G1 X95.0 Y95.0 Z8.4
M103
(</infill>)
(</nestedRing>)
(</rotation>)
(</layer>)
(<layer> 9.8 )
(<rotation> (-0.707107+0.707107j) )
(<nestedRing>)
(<boundaryPerimeter>)
(<boundaryPoint> X80.0 Y80.0 Z9.8 </boundaryPoint>)
(<boundaryPoint> X120.0 Y80.0 Z9.8 </boundaryPoint>)
(<boundaryPoint> X120.0 Y120.0 Z9.8 </boundaryPoint>)
(<boundaryPoint> X80.0 Y120.0 Z9.8 </boundaryPoint>)
(</boundaryPerimeter>)
(<loop> outer )
G1 X89.0 Y89.0 Z11.2
M101
G1 X111.0 Y89.0 Z11.2
G1 X111.0 Y111.0 Z11.2
G1 X89.0 Y111.0 Z11.2
G1 X89.0 Y89.0 Z11.2
M103
(</loop>)
(<edge> outer )
G1 X83.0 Y83.0 Z11.2
M101
G1 X117.0 Y83.0 Z11.2
G1 X117.0 Y117.0 Z11.2
G1 X83.0 Y117.0 Z11.2
G1 X83.0 Y83.0 Z11.2
M103
(</edge>)
(</nestedRing>)
(</rotation>)
(</layer>)
(<layer> 12.6 )
(<rotation> (0.707107+0.707107j) )
(<nestedRing>)
(<boundaryPerimeter>)
(<boundaryPoint> X80.0 Y80.0 Z12.6 </boundaryPoint>)
(<boundaryPoint> X120.0 Y80.0 Z12.6 </boundaryPoint>)
(<boundaryPoint> X120.0 Y120.0 Z12.6 </boundaryPoint>)
(<boundaryPoint> X80.0 Y120.0 Z12.6 </boundaryPoint>)
(</boundaryPerimeter>)
(<loop> outer )
G1 X89.0 Y89.0 Z14.0
M101
G1 X111.0 Y89.0 Z14.0
G1 X111.0 Y111.0 Z14.0
G1 X89.0 Y111.0 Z14.0
G1 X89.0 Y89.0 Z14.0
M103
(</loop>)
(<edge> outer )
G1 X83.0 Y83.0 Z14.0
M101
G1 X117.0 Y83.0 Z14.0
G1 X117.0 Y117.0 Z14.0
G1 X83.0 Y117.0 Z14.0
G1 X83.0 Y83.0 Z14.0
M103
(</edge>)
(<infill>)
G1 X95.0 Y95.0 Z14.0
M101
G1 X105.0 Y105.0 Z14.0
M103
(</infill>)
(</nestedRing>)
(</rotation>)
(</layer>)
(<layer> 15.4 )
(<rotation> (-0.707107+0.707107j) )
(<nestedRing>)
(<boundaryPerimeter>)
(<boundaryPoint> X80.0 Y80.0 Z15.4 </boundaryPoint>)
(<boundaryPoint> X120.0 Y80.0 Z15.4 </boundaryPoint>)
(<boundaryPoint> X120.0 Y120.0 Z15.4 </boundaryPoint>)
(<boundaryPoint> X80.0 Y120.0 Z15.4 </boundaryPoint>)
(</boundaryPerimeter>)
(<loop> outer )
G1 X111.0 Y111.0 Z16.8
M101
G1 X89.0 Y111.0 Z16.8
G1 X89.0 Y89.0 Z16.8
G1 X111.0 Y89.0 Z16.8
G1 X111.0 Y111.0 Z16.8
M103
(</loop>)
(<edge> outer )
G1 X117.0 Y117.0 Z16.8
M101
G1 X83.0 Y117.0 Z16.8
G1 X83.0 Y83.0 Z16.8
G1 X117.0 Y83.0 Z16.8
G1 X117.0 Y117.0 Z16.8
M103
(</edge>)
(</nestedRing>)
(</rotation>)
(</layer>)
(<layer> 18.2 )
(<rotation> (0.707107+0.707107j) )
(<nestedRing>)
(<boundaryPerimeter>)
(<boundaryPoint> X80.0 Y80.0 Z18.2 </boundaryPoint>)
(<boundaryPoint> X120.0 Y80.0 Z18.2 </boundaryPoint>)
(<boundaryPoint> X120.0 Y120.0 Z18.2 </boundaryPoint>)
(<boundaryPoint> X80.0 Y120.0 Z18.2 </boundaryPoint>)
(</boundaryPerimeter>)
(<loop> outer )
G1 X111.0 Y111.0 Z19.6
M101
G1 X89.0 Y111.0 Z19.6
G1 X89.0 Y89.0 Z19.6
G1 X111.0 Y89.0 Z19.6
G1 X111.0 Y111.0 Z19.6
M103
(</loop>)
(<edge> outer )
G1 X117.0 Y117.0 Z19.6
M101
G1 X83.0 Y117.0 Z19.6
G1 X83.0 Y83.0 Z19.6
G1 X117.0 Y83.0 Z19.6
G1 X117.0 Y117.0 Z19.6
M103
(</edge>)
(<infill>)
G1 X105.0 Y105.0 Z19.6
M101
G1 X95.0 Y95.0 Z19.6
M103
(</infill>)
(</nestedRing>)
(</rotation>)
(</layer>)
(<layer> 21.0 )
(<rotation> (-0.707107+0.707107j) )
(<nestedRing>)
(<boundaryPerimeter>)
(<boundaryPoint> X80.0 Y80.0 Z21.0 </boundaryPoint>)
(<boundaryPoint> X120.0 Y80.0 Z21.0 </boundaryPoint>)
(<boundaryPoint> X120.0 Y120.0 Z21.0 </boundaryPoint>)
(<boundaryPoint> X80.0 Y120.0 Z21.0 </boundaryPoint>)
(</boundaryPerimeter>)
(<loop> outer )
G1 X89.0 Y89.0 Z22.4
M101
G1 X111.0 Y89.0 Z22.4
G1 X111.0 Y111.0 Z22.4
G1 X89.0 Y111.0 Z22.4
G1 X89.0 Y89.0 Z22.4
M103
(</loop>)
(<edge> outer )
G1 X83.0 Y83.0 Z22.4
M101
G1 X117.0 Y83.0 Z22.4
G1 X117.0 Y117.0 Z22.4
G1 X83.0 Y117.0 Z22.4
G1 X83.0 Y83.0 Z22.4
M103
(</edge>)
(</nestedRing>)
(</rotation>)
(</layer>)
(<layer> 23.8 )
(<rotation> (0.707107+0.707107j) )
(<nestedRing>)
(<boundaryPerimeter>)
(<boundaryPoint> X80.0 Y80.0 Z23.8 </boundaryPoint>)
(<boundaryPoint> X120.0 Y80.0 Z23.8 </boundaryPoint>)
(<boundaryPoint> X120.0 Y120.0 Z23.8 </boundaryPoint>)
(<boundaryPoint> X80.0 Y120.0 Z23.8 </boundaryPoint>)
(</boundaryPerimeter>)
(<loop> outer )
G1 X89.0 Y89.0 Z25.2
M101
G1 X111.0 Y89.0 Z25.2
G1 X111.0 Y111.0 Z25.2
G1 X89.0 Y111.0 Z25.2
G1 X89.0 Y89.0 Z25.2
M103
(</loop>)
(<edge> outer )
G1 X83.0 Y83.0 Z25.2
M101
G1 X117.0 Y83.0 Z25.2
G1 X117.0 Y117.0 Z25.2
G1 X83.0 Y117.0 Z25.2
G1 X83.0 Y83.0 Z25.2
M103
(</edge>)
(<infill>)
G1 X95.0 Y95.0 Z25.2
M101
G1 X105.0 Y105.0 Z25.2
M103
(</infill>)
(</nestedRing>)
(</rotation>)
(</layer>)
(<layer> 26.6 )
(<rotation> (-0.707107+0.707107j) )
(<nestedRing>)
(<boundaryPerimeter>)
(<boundaryPoint> X80.0 Y80.0 Z26.6 </boundaryPoint>)
(<boundaryPoint> X120.0 Y80.0 Z26.6 </boundaryPoint>)
(<boundaryPoint> X120.0 Y120.0 Z26.6 </boundaryPoint>)
(<boundaryPoint> X80.0 Y120.0 Z26.6 </boundaryPoint>)
(</boundaryPerimeter>)
(<loop> outer )
G1 X111.0 Y111.0 Z28.0
M101
G1 X89.0 Y111.0 Z28.0
G1 X89.0 Y89.0 Z28.0
G1 X111.0 Y89.0 Z28.0
G1 X111.0 Y111.0 Z28.0
M103
(</loop>)
(<edge> outer )
G1 X117.0 Y117.0 Z28.0
M101
G1 X83.0 Y117.0 Z28.0
G1 X83.0 Y83.0 Z28.0
G1 X117.0 Y83.0 Z28.0
G1 X117.0 Y117.0 Z28.0
M103
(</edge>)
(</nestedRing>)
(</rotation>)
(</layer>)
(<layer> 29.4 )
(<rotation> (0.707107+0.707107j) )
(<nestedRing>)
(<boundaryPerimeter>)
(<boundaryPoint> X80.0 Y80.0 Z29.4 </boundaryPoint>)
(<boundaryPoint> X120.0 Y80.0 Z29.4 </boundaryPoint>)
(<boundaryPoint> X120.0 Y120.0 Z29.4 </boundaryPoint>)
(<boundaryPoint> X80.0 Y120.0 Z29.4 </boundaryPoint>)
(</boundaryPerimeter>)
(<loop> outer )
G1 X111.0 Y111.0 Z30.8
M101
G1 X89.0 Y111.0 Z30.8
G1 X89.0 Y89.0 Z30.8
G1 X111.0 Y89.0 Z30.8
G1 X111.0 Y111.0 Z30.8
M103
(</loop>)
(<edge> outer )
G1 X117.0 Y117.0 Z30.8
M101
G1 X83.0 Y117.0 Z30.8
G1 X83.0 Y83.0 Z30.8
G1 X117.0 Y83.0 Z30.8
G1 X117.0 Y117.0 Z30.8
M103
(</edge>)
(<infill>)
G1 X105.0 Y105.0 Z30.8
M101
G1 X95.0 Y95.0 Z30.8
M103
(</infill>)
(</nestedRing>)
(</rotation>)
(</layer>)
(<layer> 32.2 )
(<rotation> (-0.707107+0.707107j) )
(<nestedRing>)
(<boundaryPerimeter>)
(<boundaryPoint> X80.0 Y80.0 Z32.2 </boundaryPoint>)
(<boundaryPoint> X120.0 Y80.0 Z32.2 </boundaryPoint>)
(<boundaryPoint> X120.0 Y120.0 Z32.2 </boundaryPoint>)
(<boundaryPoint> X80.0 Y120.0 Z32.2 </boundaryPoint>)
(</boundaryPerimeter>)
(<loop> outer )
G1 X89.0 Y89.0 Z33.6
M101
G1 X111.0 Y89.0 Z33.6
G1 X111.0 Y111.0 Z33.6
G1 X89.0 Y111.0 Z33.6
G1 X89.0 Y89.0 Z33.6
M103
(</loop>)
(<edge> outer )
G1 X83.0 Y83.0 Z33.6
M101
G1 X117.0 Y83.0 Z33.6
G1 X117.0 Y117.0 Z33.6
G1 X83.0 Y117.0 Z33.6
G1 X83.0 Y83.0 Z33.6
M103
(</edge>)
(</nestedRing>)
(</rotation>)
(</layer>)
(<layer> 35.0 )
(<rotation> (0.707107+0.707107j) )
(<nestedRing>)
(<boundaryPerimeter>)
(<boundaryPoint> X80.0 Y80.0 Z35.0 </boundaryPoint>)
(<boundaryPoint> X120.0 Y80.0 Z35.0 </boundaryPoint>)
(<boundaryPoint> X120.0 Y120.0 Z35.0 </boundaryPoint>)
(<boundaryPoint> X80.0 Y120.0 Z35.0 </boundaryPoint>)
(</boundaryPerimeter>)
(<loop> outer )
G1 X89.0 Y89.0 Z36.4
M101
G1 X111.0 Y89.0 Z36.4
G1 X111.0 Y111.0 Z36.4
G1 X89.0 Y111.0 Z36.4
G1 X89.0 Y89.0 Z36.4
M103
(</loop>)
(<edge> outer )
G1 X83.0 Y83.0 Z36.4
M101
G1 X117.0 Y83.0 Z36.4
G1 X117.0 Y117.0 Z36.4
G1 X83.0 Y117.0 Z36.4
G1 X83.0 Y83.0 Z36.4
M103
(</edge>)
(<infill>)
G1 X104.999 Y95.0 Z36.4
M101
M108 S1.25
G1 X105.0 Y95.001 Z36.4
G1 X105.0 Y105.0 Z36.4
G1 X95.0 Y95.0 Z36.4
G1 X95.0 Y104.999 Z36.4
G1 X95.001 Y105.0 Z36.4
M103
M108 S1.0
(</infill>)
(</nestedRing>)
(</rotation>)
(</layer>)
(<layer> 37.8 )
(<rotation> (-0.707107+0.707107j) )
(<nestedRing>)
(<boundaryPerimeter>)
(<boundaryPoint> X80.0 Y80.0 Z37.8 </boundaryPoint>)
(<boundaryPoint> X120.0 Y80.0 Z37.8 </boundaryPoint>)
(<boundaryPoint> X120.0 Y120.0 Z37.8 </boundaryPoint>)
(<boundaryPoint> X80.0 Y120.0 Z37.8 </boundaryPoint>)
(</boundaryPerimeter>)
(<loop> outer )
G1 X89.0 Y111.0 Z39.2
M101
G1 X89.0 Y89.0 Z39.2
G1 X111.0 Y89.0 Z39.2
G1 X111.0 Y111.0 Z39.2
G1 X89.0 Y111.0 Z39.2
M103
(</loop>)
(<edge> outer )
G1 X83.0 Y117.0 Z39.2
M101
G1 X83.0 Y83.0 Z39.2
G1 X117.0 Y83.0 Z39.2
G1 X117.0 Y117.0 Z39.2
G1 X83.0 Y117.0 Z39.2
M103
(</edge>)
(<infill>)
G1 X95.0 Y95.001 Z39.2
M101
M108 S1.25
G1 X95.001 Y95.0 Z39.2
G1 X105.0 Y95.0 Z39.2
G1 X95.0 Y105.0 Z39.2
G1 X104.999 Y105.0 Z39.2
G1 X105.0 Y104.999 Z39.2
M103
M108 S1.0
(</infill>)
(</nestedRing>)
(</rotation>)
(</layer>)
(</crafting>)
M103
