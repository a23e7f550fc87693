function kp(){let n=this.buf,e=this.pos,t=0,i=0;for(let r=0;r<28;r+=7){let o=n[e++];if(t|=(o&127)<<r,(o&128)==0){this.pos=e,this.assertBounds(),this.varint64Lo=t,this.varint64Hi=i;return}}let s=n[e++];if(t|=(s&15)<<28,i=(s&112)>>4,(s&128)==0){this.pos=e,this.assertBounds(),this.varint64Lo=t,this.varint64Hi=i;return}for(let r=3;r<=31;r+=7){let o=n[e++];if(i|=(o&127)<<r,(o&128)==0){this.pos=e,this.assertBounds(),this.varint64Lo=t,this.varint64Hi=i;return}}throw new Error("invalid varint")}var ya=4294967296;function Su(n){let e=n[0]==="-";e&&(n=n.slice(1));let t=1e6,i=0,s=0;function r(o,a){let l=Number(n.slice(o,a));s*=t,i=i*t+l,i>=ya&&(s=s+(i/ya|0),i=i%ya)}return r(-24,-18),r(-18,-12),r(-12,-6),r(-6),e?zp(i,s):Eu(i,s)}function Wp(n,e){let t=Eu(n,e),i=t.hi&2147483648;i&&(t=zp(t.lo,t.hi));let s=_u(t.lo,t.hi);return i?"-"+s:s}function _u(n,e){if({lo:n,hi:e}=ux(n,e),e<=2097151)return String(ya*e+n);let t=n&16777215,i=(n>>>24|e<<8)&16777215,s=e>>16&65535,r=t+i*6777216+s*6710656,o=i+s*8147497,a=s*2,l=1e7;return r>=l&&(o+=Math.floor(r/l),r%=l),o>=l&&(a+=Math.floor(o/l),o%=l),a.toString()+Op(o)+Op(r)}function ux(n,e){return{lo:n>>>0,hi:e>>>0}}function Eu(n,e){return{lo:n|0,hi:e|0}}function zp(n,e){return e=~e,n?n=~n+1:e+=1,Eu(n,e)}var Op=n=>{let e=String(n);return"0000000".slice(e.length)+e};function Xp(n,e){if(n>>>0<128){e.push(n);return}if(n>=0){for(;n>127;)e.push(n&127|128),n=n>>>7;e.push(n)}else{for(let t=0;t<9;t++)e.push(n&127|128),n=n>>7;e.push(1)}}function Zp(){let n=this.buf[this.pos++];if((n&128)===0)return this.assertBounds(),n;let e=n&127;if(n=this.buf[this.pos++],e|=(n&127)<<7,(n&128)===0)return this.assertBounds(),e;if(n=this.buf[this.pos++],e|=(n&127)<<14,(n&128)===0)return this.assertBounds(),e;if(n=this.buf[this.pos++],e|=(n&127)<<21,(n&128)===0)return this.assertBounds(),e;n=this.buf[this.pos++],e|=(n&15)<<28;for(let t=5;(n&128)!==0&&t<10;t++)n=this.buf[this.pos++];if((n&128)!==0)throw new Error("invalid varint");return this.assertBounds(),e>>>0}var $e=dx();function dx(){let n=new DataView(new ArrayBuffer(8));if(typeof BigInt=="function"&&typeof n.getBigInt64=="function"&&typeof n.getBigUint64=="function"&&typeof n.setBigInt64=="function"&&typeof n.setBigUint64=="function"&&(!!globalThis.Deno||!!globalThis.Bun||typeof process!="object"||typeof process.env!="object"||process.env.BUF_BIGINT_DISABLE!=="1")){let t=BigInt("-9223372036854775808"),i=BigInt("9223372036854775807"),s=BigInt("0"),r=BigInt("18446744073709551615");return{zero:BigInt(0),supported:!0,parse(o){let a=typeof o=="bigint"?o:BigInt(o);if(a>i||a<t)throw new Error(`invalid int64: ${o}`);return a},uParse(o){let a=typeof o=="bigint"?o:BigInt(o);if(a>r||a<s)throw new Error(`invalid uint64: ${o}`);return a},enc(o){return n.setBigInt64(0,this.parse(o),!0),{lo:n.getInt32(0,!0),hi:n.getInt32(4,!0)}},uEnc(o){return n.setBigInt64(0,this.uParse(o),!0),{lo:n.getInt32(0,!0),hi:n.getInt32(4,!0)}},dec(o,a){return n.setInt32(0,o,!0),n.setInt32(4,a,!0),n.getBigInt64(0,!0)},uDec(o,a){return n.setInt32(0,o,!0),n.setInt32(4,a,!0),n.getBigUint64(0,!0)}}}return{zero:"0",supported:!1,parse(t){return typeof t!="string"&&(t=t.toString()),Hp(t),t},uParse(t){return typeof t!="string"&&(t=t.toString()),Yp(t),t},enc(t){return typeof t!="string"&&(t=t.toString()),Hp(t),Su(t)},uEnc(t){return typeof t!="string"&&(t=t.toString()),Yp(t),Su(t)},dec(t,i){return Wp(t,i)},uDec(t,i){return _u(t,i)}}}function Hp(n){if(!/^-?[0-9]+$/.test(n))throw new Error("invalid int64: "+n)}function Yp(n){if(!/^[0-9]+$/.test(n))throw new Error("invalid uint64: "+n)}var Au;function hx(n){var e;Au=Object.assign(Object.assign({},n),{encodeUtf8Into:(e=n.encodeUtf8Into)!==null&&e!==void 0?e:Mu(n.encodeUtf8.bind(n))})}function kr(){if(!Au){let n=globalThis;if(!n.TextEncoder||!n.TextDecoder)throw new Error("encoding API missing: install TextEncoder and TextDecoder on globalThis");let e=new n.TextEncoder,t=new n.TextDecoder("utf-8",{ignoreBOM:!0}),i,s={encodeUtf8(o){return e.encode(o)},decodeUtf8(o,a){return a?(i||(i=new n.TextDecoder("utf-8",{fatal:!0,ignoreBOM:!0})),i.decode(o)):t.decode(o)},checkUtf8(o){try{return encodeURIComponent(o),!0}catch{return!1}}};e.encodeInto&&(s.encodeUtf8Into=e.encodeInto.bind(e));let r=String.prototype.isWellFormed;r&&(s.checkUtf8=o=>r.call(o)),hx(s)}return Au}function Mu(n){return(e,t)=>{let i=n(e);return t.set(i),{written:i.byteLength}}}var pt;(function(n){n[n.Varint=0]="Varint",n[n.Bit64=1]="Bit64",n[n.LengthDelimited=2]="LengthDelimited",n[n.StartGroup=3]="StartGroup",n[n.EndGroup=4]="EndGroup",n[n.Bit32=5]="Bit32"})(pt||(pt={}));var Tu=4294967295,Cu=2147483647,Iu=-2147483648,Ps=class{constructor(e){this.stackPos=[],this.encodeUtf8Into=e?Mu(e):kr().encodeUtf8Into,this.buffer=Qp,this.viewCache=fx,this.pos=0}ensureCapacity(e){let t=this.pos+e;if(t>this.buffer.length){let i=this.buffer.length||px;for(;i<t;)i*=2;let s=new Uint8Array(i);this.pos>0&&s.set(this.buffer),this.buffer=s}}view(){let e=this.buffer,t=this.viewCache;if(t.byteLength===e.byteLength)return t;let i=new DataView(e.buffer);return this.viewCache=i,i}finish(){let e=this.buffer.slice(0,this.pos);return this.pos=0,this.stackPos=[],e}fork(){return this.stackPos.push(this.pos),this.ensureCapacity(Wr),this.buffer[this.pos++]=0,this}join(){let e=this.stackPos.pop();if(e===void 0)throw new Error("invalid state, fork stack empty");let t=this.pos-e-Wr,i=Ru(t);return i>Wr&&(this.ensureCapacity(i-Wr),this.buffer.copyWithin(e+i,e+Wr,this.pos)),this.pos=e,this.uint32(t),this.pos+=t,this}tag(e,t){return this.uint32((e<<3|t)>>>0)}raw(e){return this.ensureCapacity(e.length),this.buffer.set(e,this.pos),this.pos+=e.length,this}uint32(e){if(Jp(e),this.ensureCapacity(5),e<128)return this.buffer[this.pos++]=e,this;for(;e>127;)this.buffer[this.pos++]=e&127|128,e>>>=7;return this.buffer[this.pos++]=e,this}int32(e){if(wu(e),e>=0)return this.uint32(e);this.ensureCapacity(10);for(let t=0;t<9;t++)this.buffer[this.pos++]=e&127|128,e>>=7;return this.buffer[this.pos++]=1,this}bool(e){return this.ensureCapacity(1),this.buffer[this.pos++]=e?1:0,this}bytes(e){return this.uint32(e.byteLength),this.raw(e)}string(e){typeof e!="string"&&(e=String(e));let t=e.length;if(t<=Kp){this.ensureCapacity(t+1);let l=this.buffer,c=this.pos;l[c++]=t;let u=0;for(;u<t;u++){let h=e.charCodeAt(u);if(h>127)break;l[c++]=h}if(u==t)return this.pos=c,this}this.ensureCapacity(t*3+5);let i=Ru(t),s=this.buffer,r=this.pos,{written:o}=this.encodeUtf8Into(e,s.subarray(r+i)),a=Ru(o);return a!=i&&s.copyWithin(r+a,r+i,r+i+o),this.uint32(o),this.pos+=o,this}float(e){return mx(e),this.ensureCapacity(4),this.view().setFloat32(this.pos,e,!0),this.pos+=4,this}double(e){return this.ensureCapacity(8),this.view().setFloat64(this.pos,e,!0),this.pos+=8,this}fixed32(e){return Jp(e),this.ensureCapacity(4),this.view().setUint32(this.pos,e,!0),this.pos+=4,this}sfixed32(e){return wu(e),this.ensureCapacity(4),this.view().setInt32(this.pos,e,!0),this.pos+=4,this}sint32(e){return wu(e),this.uint32((e<<1^e>>31)>>>0)}sfixed64(e){let t=$e.enc(e);this.ensureCapacity(8);let i=this.view();return i.setInt32(this.pos,t.lo,!0),i.setInt32(this.pos+4,t.hi,!0),this.pos+=8,this}fixed64(e){let t=$e.uEnc(e);this.ensureCapacity(8);let i=this.view();return i.setInt32(this.pos,t.lo,!0),i.setInt32(this.pos+4,t.hi,!0),this.pos+=8,this}int64(e){let t=$e.enc(e);return this.writeVarint64(t.lo,t.hi)}sint64(e){let t=$e.enc(e),i=t.hi>>31,s=t.lo<<1^i,r=(t.hi<<1|t.lo>>>31)^i;return this.writeVarint64(s,r)}uint64(e){let t=$e.uEnc(e);return this.writeVarint64(t.lo,t.hi)}writeVarint64(e,t){this.ensureCapacity(10);let i=this.buffer,s=this.pos;for(let a=0;a<28;a=a+7){let l=e>>>a,c=!(!(l>>>7)&&t==0);if(i[s++]=(c?l|128:l)&255,!c)return this.pos=s,this}let r=e>>>28&15|(t&7)<<4,o=t>>3!=0;if(i[s++]=(o?r|128:r)&255,!o)return this.pos=s,this;for(let a=3;a<31;a=a+7){let l=t>>>a,c=!!(l>>>7);if(i[s++]=(c?l|128:l)&255,!c)return this.pos=s,this}return i[s++]=t>>>31&1,this.pos=s,this}},px=128,Wr=1,Qp=new Uint8Array(0),fx=new DataView(Qp.buffer),Kp=32;function Ru(n){return n<128?1:n<16384?2:n<2097152?3:n<268435456?4:5}var Vn=class{constructor(e,t=kr().decodeUtf8){this.decodeUtf8=t,this.varint64Lo=0,this.varint64Hi=0,this.varint64=kp,this.uint32=Zp,this.buf=e,this.len=e.length,this.pos=0,this.view=new DataView(e.buffer,e.byteOffset,e.byteLength)}tag(){let e=this.pos,t=this.uint32(),i=this.pos-e;if(i>5||i==5&&this.buf[this.pos-1]>15)throw new Error("illegal tag: varint overflows uint32");let s=t>>>3,r=t&7;if(s<=0||r>5)throw new Error("illegal tag: field no "+s+" wire type "+r);return[s,r]}skip(e,t,i=100){let s=this.pos;switch(e){case pt.Varint:for(;this.buf[this.pos++]&128;);break;case pt.Bit64:this.pos+=4;case pt.Bit32:this.pos+=4;break;case pt.LengthDelimited:let r=this.uint32();this.pos+=r;break;case pt.StartGroup:if(i<=0)throw new Error("maximum recursion depth reached");for(;;){let[o,a]=this.tag();if(a===pt.EndGroup){if(t!==void 0&&o!==t)throw new Error("invalid end group tag");break}this.skip(a,o,i-1)}break;default:throw new Error("cant skip wire type "+e)}return this.assertBounds(),this.buf.subarray(s,this.pos)}assertBounds(){if(this.pos>this.len)throw new RangeError("premature EOF")}int32(){return this.uint32()|0}sint32(){let e=this.uint32();return e>>>1^-(e&1)}int64(){return this.varint64(),$e.dec(this.varint64Lo,this.varint64Hi)}uint64(){return this.varint64(),$e.uDec(this.varint64Lo,this.varint64Hi)}sint64(){this.varint64();let e=this.varint64Lo,t=this.varint64Hi,i=-(e&1);return e=(e>>>1|(t&1)<<31)^i,t=t>>>1^i,$e.dec(e,t)}bool(){let e=this.buf[this.pos];return e<128?(this.pos++,e!==0):(this.varint64(),this.varint64Lo!==0||this.varint64Hi!==0)}fixed32(){return this.view.getUint32((this.pos+=4)-4,!0)}sfixed32(){return this.view.getInt32((this.pos+=4)-4,!0)}fixed64(){return $e.uDec(this.sfixed32(),this.sfixed32())}sfixed64(){return $e.dec(this.sfixed32(),this.sfixed32())}float(){return this.view.getFloat32((this.pos+=4)-4,!0)}double(){return this.view.getFloat64((this.pos+=8)-8,!0)}bytes(){let e=this.uint32(),t=this.pos;return this.pos+=e,this.assertBounds(),this.buf.subarray(t,t+e)}string(e){let t=this.uint32(),i=this.pos;this.pos+=t,this.assertBounds();let s=this.buf;if(t<=Kp){let r=new Array(t);for(let o=0;o<t;o++){let a=s[i+o];if(a>127)return this.decodeUtf8(s.subarray(i,this.pos),e);r[o]=a}return String.fromCharCode.apply(String,r)}return this.decodeUtf8(s.subarray(i,this.pos),e)}};function wu(n){if(typeof n=="string")n=Number(n);else if(typeof n!="number")throw new Error("invalid int32: "+typeof n);if(!Number.isInteger(n)||n>Cu||n<Iu)throw new Error("invalid int32: "+n)}function Jp(n){if(typeof n=="string")n=Number(n);else if(typeof n!="number")throw new Error("invalid uint32: "+typeof n);if(!Number.isInteger(n)||n>Tu||n<0)throw new Error("invalid uint32: "+n)}function mx(n){if(typeof n=="string"){let e=n;if(n=Number(n),Number.isNaN(n)&&e!=="NaN")throw new Error("invalid float32: "+e)}else if(typeof n!="number")throw new Error("invalid float32: "+typeof n);if(!Number.isFinite(Math.fround(n))&&Number.isFinite(n))throw new Error("invalid float32: "+n)}var qp=Uint8Array.prototype.setFromBase64;function Gs(n){let e=n.length,t=e-(e+3>>2);(e&3)==0&&n[e-1]=="="&&(t-=n[e-2]=="="?2:1);let i=new Uint8Array(t),s=-1;if(qp)try{let r=qp.call(i,n);r.read==e&&(s=r.written)}catch{}return s<0&&(s=gx(i,n)),s==t?i:i.subarray(0,s)}function gx(n,e){let t=bx(),i=0,s=0,r,o=0;for(let a=0;a<e.length;a++){if(r=t[e.charCodeAt(a)],r===void 0)switch(e[a]){case"=":s=0;case`
`:case"\r":case"	":case" ":continue;default:throw Error("invalid base64 string")}switch(s){case 0:o=r,s=1;break;case 1:n[i++]=o<<2|(r&48)>>4,o=r,s=2;break;case 2:n[i++]=(o&15)<<4|(r&60)>>2,o=r,s=3;break;case 3:n[i++]=(o&3)<<6|r,s=0;break}}if(s==1)throw Error("invalid base64 string");return i}var jp=Uint8Array.prototype.toBase64,yx={std:{alphabet:"base64",omitPadding:!1},std_raw:{alphabet:"base64",omitPadding:!0},url:{alphabet:"base64url",omitPadding:!0}};function Nu(n,e="std"){if(jp)return jp.call(n,yx[e]);let t=ef(e),i=e=="std",s="",r=0,o,a=0;for(let l=0;l<n.length;l++)switch(o=n[l],r){case 0:s+=t[o>>2],a=(o&3)<<4,r=1;break;case 1:s+=t[a|o>>4],a=(o&15)<<2,r=2;break;case 2:s+=t[a|o>>6],s+=t[o&63],r=0;break}return r&&(s+=t[a],i&&(s+="=",r==1&&(s+="="))),s}var ba,$p,Ds;function ef(n){return ba||(ba="ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/".split(""),$p=ba.slice(0,-2).concat("-","_")),n=="url"?$p:ba}function bx(){if(!Ds){Ds=[];let n=ef("std");for(let e=0;e<n.length;e++)Ds[n[e].charCodeAt(0)]=e;Ds[45]=n.indexOf("+"),Ds[95]=n.indexOf("/")}return Ds}var N;(function(n){n[n.DOUBLE=1]="DOUBLE",n[n.FLOAT=2]="FLOAT",n[n.INT64=3]="INT64",n[n.UINT64=4]="UINT64",n[n.INT32=5]="INT32",n[n.FIXED64=6]="FIXED64",n[n.FIXED32=7]="FIXED32",n[n.BOOL=8]="BOOL",n[n.STRING=9]="STRING",n[n.BYTES=12]="BYTES",n[n.UINT32=13]="UINT32",n[n.SFIXED32=15]="SFIXED32",n[n.SFIXED64=16]="SFIXED64",n[n.SINT32=17]="SINT32",n[n.SINT64=18]="SINT64"})(N||(N={}));function tf(n,e){let t=n.values.find(i=>i.name===e);if(!t)throw new Error(`cannot parse ${n} default value: ${e}`);return t.number}function nf(n,e){switch(n){case N.STRING:return e;case N.BYTES:{let t=xx(e);if(t===!1)throw new Error(`cannot parse ${N[n]} default value: ${e}`);return t}case N.INT64:case N.SFIXED64:case N.SINT64:return $e.parse(e);case N.UINT64:case N.FIXED64:return $e.uParse(e);case N.DOUBLE:case N.FLOAT:switch(e){case"inf":return Number.POSITIVE_INFINITY;case"-inf":return Number.NEGATIVE_INFINITY;case"nan":return Number.NaN;default:return parseFloat(e)}case N.BOOL:return e==="true";case N.INT32:case N.UINT32:case N.SINT32:case N.FIXED32:case N.SFIXED32:return parseInt(e,10)}}function xx(n){let e=[],t={tail:n,c:"",next(){return this.tail.length==0?!1:(this.c=this.tail[0],this.tail=this.tail.substring(1),!0)},take(i){if(this.tail.length>=i){let s=this.tail.substring(0,i);return this.tail=this.tail.substring(i),s}return!1}};for(;t.next();)switch(t.c){case"\\":if(t.next())switch(t.c){case"\\":e.push(t.c.charCodeAt(0));break;case"b":e.push(8);break;case"f":e.push(12);break;case"n":e.push(10);break;case"r":e.push(13);break;case"t":e.push(9);break;case"v":e.push(11);break;case"0":case"1":case"2":case"3":case"4":case"5":case"6":case"7":{let i=t.c,s=t.take(2);if(s===!1)return!1;let r=parseInt(i+s,8);if(Number.isNaN(r))return!1;e.push(r);break}case"x":{let i=t.c,s=t.take(2);if(s===!1)return!1;let r=parseInt(i+s,16);if(Number.isNaN(r))return!1;e.push(r);break}case"u":{let i=t.c,s=t.take(4);if(s===!1)return!1;let r=parseInt(i+s,16);if(Number.isNaN(r))return!1;let o=new Uint8Array(4);new DataView(o.buffer).setInt32(0,r,!0),e.push(o[0],o[1],o[2],o[3]);break}case"U":{let i=t.c,s=t.take(8);if(s===!1)return!1;let r=$e.uEnc(i+s),o=new Uint8Array(8),a=new DataView(o.buffer);a.setInt32(0,r.lo,!0),a.setInt32(4,r.hi,!0),e.push(o[0],o[1],o[2],o[3],o[4],o[5],o[6],o[7]);break}}break;default:e.push(t.c.charCodeAt(0))}return new Uint8Array(e)}var vx=["FieldValueInvalidError","FieldListRangeError","ForeignFieldError"],et=class extends Error{constructor(e,t,i="FieldValueInvalidError"){super(t),this.name=i,this.field=()=>e}};function sf(n){return n instanceof Error&&vx.includes(n.name)&&"field"in n&&typeof n.field=="function"}function sn(n,e){switch(n){case N.STRING:return"";case N.BOOL:return!1;case N.DOUBLE:case N.FLOAT:return 0;case N.INT64:case N.UINT64:case N.SFIXED64:case N.FIXED64:case N.SINT64:return e?"0":$e.zero;case N.BYTES:return new Uint8Array(0);default:return 0}}function rf(n,e){switch(n){case N.BOOL:return e===!1;case N.STRING:return e==="";case N.BYTES:return e instanceof Uint8Array&&!e.byteLength;case N.DOUBLE:case N.FLOAT:return Object.is(e,0);default:return e==0}}var of=2,Vt=Symbol.for("reflect unsafe local");function af(n,e){let t=n[e.localName].case;return t===void 0?t:e.fields.find(i=>i.localName===t)}function lf(n,e){let t=e.localName;if(e.oneof)return n[e.oneof.localName].case===t;if(e.presence!=of)return n[t]!==void 0&&Object.prototype.hasOwnProperty.call(n,t);switch(e.fieldKind){case"list":return n[t].length>0;case"map":return Object.keys(n[t]).length>0;case"scalar":return!rf(e.scalar,n[t]);case"enum":return n[t]!==e.enum.values[0].number}throw new Error("message field with implicit presence")}function fs(n,e){return Object.prototype.hasOwnProperty.call(n,e)&&n[e]!==void 0}function cf(n,e){if(e.oneof){let t=n[e.oneof.localName];return t.case===e.localName?t.value:void 0}return n[e.localName]}function uf(n,e,t){e.oneof?n[e.oneof.localName]={case:e.localName,value:t}:n[e.localName]=t}function jt(n,e,t){e==="__proto__"?Object.defineProperty(n,"__proto__",{value:t,writable:!0,enumerable:!0,configurable:!0}):n[e]=t}function df(n,e){return Object.prototype.hasOwnProperty.call(n,e)?n[e]:void 0}function hf(n,e){let t=e.localName;if(e.oneof){let i=e.oneof.localName;n[i].case===t&&(n[i]={case:void 0})}else if(e.presence!=of)delete n[t];else switch(e.fieldKind){case"map":n[t]={};break;case"list":n[t]=[];break;case"enum":n[t]=e.enum.values[0].number;break;case"scalar":n[t]=sn(e.scalar,e.longAsString);break}}function zr(n,e){return n!==null&&typeof n=="object"&&"$typeName"in n&&typeof n.$typeName=="string"?e===void 0?!0:e.typeName===n.$typeName:!1}function qn(n){return n!==null&&typeof n=="object"&&!Array.isArray(n)}function Xr(n,e){var t,i,s,r;if(qn(n)&&Vt in n&&"add"in n&&"field"in n&&typeof n.field=="function"){if(e!==void 0){let o=e,a=n.field();return o.listKind==a.listKind&&o.scalar===a.scalar&&((t=o.message)===null||t===void 0?void 0:t.typeName)===((i=a.message)===null||i===void 0?void 0:i.typeName)&&((s=o.enum)===null||s===void 0?void 0:s.typeName)===((r=a.enum)===null||r===void 0?void 0:r.typeName)}return!0}return!1}function Zr(n,e){var t,i,s,r;if(qn(n)&&Vt in n&&"has"in n&&"field"in n&&typeof n.field=="function"){if(e!==void 0){let o=e,a=n.field();return o.mapKey===a.mapKey&&o.mapKind==a.mapKind&&o.scalar===a.scalar&&((t=o.message)===null||t===void 0?void 0:t.typeName)===((i=a.message)===null||i===void 0?void 0:i.typeName)&&((s=o.enum)===null||s===void 0?void 0:s.typeName)===((r=a.enum)===null||r===void 0?void 0:r.typeName)}return!0}return!1}function Hr(n,e){return qn(n)&&Vt in n&&"desc"in n&&qn(n.desc)&&n.desc.kind==="message"&&(e===void 0||n.desc.typeName==e.typeName)}function pf(n){return ff(n.$typeName)}function Tn(n){let e=n.fields[0];return ff(n.typeName)&&e!==void 0&&e.fieldKind=="scalar"&&e.name=="value"&&e.number==1}function xa(n){switch(n.typeName){case"google.protobuf.Any":case"google.protobuf.Timestamp":case"google.protobuf.Duration":case"google.protobuf.FieldMask":case"google.protobuf.Struct":case"google.protobuf.Value":case"google.protobuf.ListValue":return!0;default:return Tn(n)}}var Sx=new Set(["google.protobuf.DoubleValue","google.protobuf.FloatValue","google.protobuf.Int64Value","google.protobuf.UInt64Value","google.protobuf.Int32Value","google.protobuf.UInt32Value","google.protobuf.BoolValue","google.protobuf.StringValue","google.protobuf.BytesValue"]);function ff(n){return Sx.has(n)}var _x=999,Ex=998,gf=2;function vt(n,e){return zr(e,n)?e:yf(n)(e)}var mf=new WeakMap;function yf(n){let e=mf.get(n);return e===void 0&&(e=Ax(n),mf.set(n,e)),e}var Bu=0,bf=1,xf=2,vf=3;function Ax(n){let e=n.typeName,{properties:t,prototype:i}=Mx(n);return s=>{let r;i!==void 0?(r=Object.create(i),r.$typeName=e):r={$typeName:e};for(let o=0;o<t.length;o++){let a=t[o],l=a.name,c=s?.[l];switch(a.kind){case Bu:c!=null?r[l]=a.convert!==void 0?a.convert(c):c:a.constant!==void 0&&(r[l]=a.constant);break;case bf:r[l]=a.convert!==void 0&&Array.isArray(c)?c.map(a.convert):c??[];break;case xf:if(a.convert===void 0||!qn(c))r[l]=c??{};else{let u={},h=Object.keys(c);for(let p=0;p<h.length;p++)jt(u,h[p],a.convert(c[h[p]]));r[l]=u}break;case vf:{let u=c;if(u?.case!=null){let h=a.convert.get(u.case);if(h!==void 0){r[l]={case:u.case,value:h(u.value)};break}}r[l]={case:void 0};break}}}return r}}function Mx(n){var e,t;let i=[],s={},r=wx(n);for(let o of n.members){let a=o.localName;if(o.kind=="oneof"){i.push({name:a,kind:vf,constant:void 0,convert:Rx(o)});continue}switch(o.fieldKind){case"message":{i.push({name:a,kind:Bu,constant:void 0,convert:va(o)});break}case"list":{i.push({name:a,kind:bf,constant:void 0,convert:o.listKind=="message"?(e=va(o))!==null&&e!==void 0?e:(l=>l):o.scalar==N.BYTES?Yr:void 0});break}case"map":{i.push({name:a,kind:xf,constant:void 0,convert:o.mapKind=="message"?(t=va(o))!==null&&t!==void 0?t:(l=>l):o.scalar==N.BYTES?Yr:void 0});break}default:{let l=Tx(o);i.push({name:a,kind:Bu,constant:o.presence==gf?l:void 0,convert:o.fieldKind=="scalar"&&o.scalar==N.BYTES?Yr:void 0}),r&&(s[a]=l);break}}}return{properties:i,prototype:r?s:void 0}}function Rx(n){let e=new Map;for(let t of n.fields){let i;t.fieldKind=="message"?i=va(t):t.fieldKind=="scalar"&&t.scalar==N.BYTES&&(i=Yr),e.set(t.localName,i??(s=>s))}return e}function va(n){if(n.fieldKind=="message"&&!n.oneof&&Tn(n.message))return n.message.fields[0].scalar==N.BYTES?Yr:void 0;if(n.message.typeName=="google.protobuf.Struct"&&n.parent.typeName!=="google.protobuf.Value")return;let e=n.message,t;return i=>!qn(i)||zr(i,e)?i:(t??(t=yf(e)),t(i))}function Yr(n){return Array.isArray(n)?new Uint8Array(n):n}function wx(n){switch(n.file.edition){case _x:return!1;case Ex:return!0;default:return n.fields.some(e=>e.presence!=gf&&e.fieldKind!="message"&&!e.oneof)}}function Tx(n){let e=n.getDefaultValue();return e!==void 0?n.fieldKind=="scalar"&&n.longAsString?e.toString():e:n.fieldKind=="scalar"?sn(n.scalar,n.longAsString):n.enum.values[0].number}var Cx=0;function _n(n){if(Ix(n))return{toMessage:t=>Sa(t),toLocal:t=>_a(t)};if(n.fieldKind=="message"&&!n.oneof&&Tn(n.message)){let t=n.message,i=t.fields[0].localName;return{toMessage:s=>{let r=vt(t);return s!==void 0&&(r[i]=s),r},toLocal:s=>s[i]}}let e=n.message;return{toMessage:t=>t===void 0?vt(e):t,toLocal:t=>t}}function Ix(n){return n.message.typeName=="google.protobuf.Struct"&&n.parent.typeName!="google.protobuf.Value"}function Sa(n){let e={$typeName:"google.protobuf.Struct",fields:{}};if(qn(n))for(let t of Object.keys(n))jt(e.fields,t,_f(n[t]));return e}function _a(n){let e={};for(let t of Object.keys(n.fields))jt(e,t,Sf(n.fields[t]));return e}function Sf(n){switch(n.kind.case){case"structValue":return _a(n.kind.value);case"listValue":return n.kind.value.values.map(Sf);case"nullValue":case void 0:return null;default:return n.kind.value}}function _f(n){let e={$typeName:"google.protobuf.Value",kind:{case:void 0}};switch(typeof n){case"number":e.kind={case:"numberValue",value:n};break;case"string":e.kind={case:"stringValue",value:n};break;case"boolean":e.kind={case:"boolValue",value:n};break;case"object":if(n===null)e.kind={case:"nullValue",value:Cx};else if(Array.isArray(n)){let t={$typeName:"google.protobuf.ListValue",values:[]};if(Array.isArray(n))for(let i of n)t.values.push(_f(i));e.kind={case:"listValue",value:t}}else e.kind={case:"structValue",value:Sa(n)};break}return e}var Nx=2,Bx=3,Ef={writeUnknownFields:!0};function Lx(n){return n?Object.assign(Object.assign({},Ef),n):Ef}function Vs(n,e,t){let i=new Ps;return Lu(n)(i,Lx(t),e),i.finish()}var Af=new WeakMap;function Lu(n){let e=Af.get(n);return e===void 0&&(e=Fx(n)),e}function Fx(n){let e=n.typeName,t=n.fields.concat().sort((o,a)=>o.number-a.number),i=t[0],s=[],r=(o,a,l)=>{if(l.$typeName!==e&&i!==void 0)throw new et(i,`cannot use ${i} with message ${l.$typeName}`,"ForeignFieldError");for(let u=0;u<s.length;u++)s[u](o,a,l);let c=l.$unknown;if(c!==void 0&&a.writeUnknownFields)for(let u=0;u<c.length;u++){let{no:h,wireType:p,data:d}=c[u];o.tag(h,p).raw(d)}};Af.set(n,r);for(let o of t)s.push(Mf(o));return r}function Mf(n){switch(n.fieldKind){case"message":case"scalar":case"enum":return Ux(n);case"list":return Dx(n);case"map":return Gx(n)}}function Ux(n){let e=Px(n),t=n.localName;if(n.oneof){let i=n.oneof.localName;return(s,r,o)=>{let a=o[i];a.case===t&&e(s,r,a.value)}}if(n.presence!=Nx){let i=n.presence==Bx?`cannot encode ${n} to binary: required field not set`:void 0;return(s,r,o)=>{let a=o[t];if(a!==void 0&&Object.prototype.hasOwnProperty.call(o,t))e(s,r,a);else if(i!==void 0)throw new Error(i)}}if(n.fieldKind=="enum"){let i=n.enum.values[0].number;return(s,r,o)=>{let a=o[t];a!==i&&e(s,r,a)}}switch(n.scalar){case N.BOOL:return(i,s,r)=>{let o=r[t];o!==!1&&e(i,s,o)};case N.STRING:return(i,s,r)=>{let o=r[t];o!==""&&e(i,s,o)};case N.BYTES:return(i,s,r)=>{let o=r[t];(!(o instanceof Uint8Array)||o.byteLength>0)&&e(i,s,o)};case N.DOUBLE:case N.FLOAT:return(i,s,r)=>{let o=r[t];Object.is(o,0)||e(i,s,o)};default:return(i,s,r)=>{let o=r[t];o!=0&&e(i,s,o)}}}function Px(n){switch(n.fieldKind){case"message":{let{toMessage:e}=_n(n),t=wf(n);return(i,s,r)=>{t(i,s,e(r))}}case"scalar":case"enum":{let e=n.fieldKind=="enum"?N.INT32:n.scalar,t=n.number,i=Aa(e),s=Ea(e,n.parent.typeName,n.name);return(r,o,a)=>{r.tag(t,i),s(r,a)}}}}function Dx(n){let e=n.localName,t=n.number;switch(n.listKind){case"message":{let{toMessage:i}=_n(n),s=wf(n);return(r,o,a)=>{let l=a[e];for(let c=0;c<l.length;c++)s(r,o,i(l[c]))}}case"scalar":case"enum":{let i=n.listKind=="enum"?N.INT32:n.scalar,s=Ea(i,n.parent.typeName,n.name);if(n.packed)return(o,a,l)=>{let c=l[e];if(c.length!=0){o.tag(t,pt.LengthDelimited).fork();for(let u=0;u<c.length;u++)s(o,c[u]);o.join()}};let r=Aa(i);return(o,a,l)=>{let c=l[e];for(let u=0;u<c.length;u++)o.tag(t,r),s(o,c[u])}}}}function Gx(n){let e=n.localName,t=n.number,i=Vx(n);if(n.mapKind=="message"){let{toMessage:a}=_n(n),l=Lu(n.message);return(c,u,h)=>{let p=h[e],d=Object.keys(p);for(let f=0;f<d.length;f++){let b=d[f];c.tag(t,pt.LengthDelimited).fork(),i(c,b),c.tag(2,pt.LengthDelimited).fork(),l(c,u,a(p[b])),c.join(),c.join()}}}let s=n.mapKind=="enum"?N.INT32:n.scalar,r=Aa(s),o=Ea(s,n.parent.typeName,n.name);return(a,l,c)=>{let u=c[e],h=Object.keys(u);for(let p=0;p<h.length;p++){let d=h[p];a.tag(t,pt.LengthDelimited).fork(),i(a,d),a.tag(2,r),o(a,u[d]),a.join()}}}function Vx(n){let e=Aa(n.mapKey),t=Ea(n.mapKey,n.parent.typeName,n.name),i=Ox(n.mapKey);return(s,r)=>{s.tag(1,e),t(s,i(r))}}function Ox(n){switch(n){case N.STRING:return e=>e;case N.BOOL:return e=>e==="true"?!0:e==="false"?!1:e;case N.UINT64:case N.FIXED64:return e=>{try{return $e.uParse(e)}catch{return e}};case N.INT64:case N.SFIXED64:case N.SINT64:return e=>{try{return $e.parse(e)}catch{return e}};default:return e=>{let t=Number.parseInt(e);return Number.isFinite(t)?t:e}}}function Ea(n,e,t){let i=kx(n);return(s,r)=>{try{i(s,r)}catch(o){throw o instanceof Error?new Error(`cannot encode field ${e}.${t} to binary: ${o.message}`):o}}}function kx(n){switch(n){case N.STRING:return(e,t)=>e.string(t);case N.BOOL:return(e,t)=>e.bool(t);case N.DOUBLE:return(e,t)=>e.double(t);case N.FLOAT:return(e,t)=>e.float(t);case N.INT32:return(e,t)=>e.int32(t);case N.INT64:return(e,t)=>e.int64(t);case N.UINT64:return(e,t)=>e.uint64(t);case N.FIXED64:return(e,t)=>e.fixed64(t);case N.BYTES:return(e,t)=>e.bytes(t);case N.FIXED32:return(e,t)=>e.fixed32(t);case N.SFIXED32:return(e,t)=>e.sfixed32(t);case N.SFIXED64:return(e,t)=>e.sfixed64(t);case N.SINT64:return(e,t)=>e.sint64(t);case N.UINT32:return(e,t)=>e.uint32(t);case N.SINT32:return(e,t)=>e.sint32(t)}}function Rf(n,e,t,i){Mf(i)(n,e,t[Vt])}function wf(n){let e=n.number,t=Lu(n.message);return n.delimitedEncoding?(i,s,r)=>{i.tag(e,pt.StartGroup),t(i,s,r),i.tag(e,pt.EndGroup)}:(i,s,r)=>{i.tag(e,pt.LengthDelimited).fork(),t(i,s,r),i.join()}}function Aa(n){switch(n){case N.BYTES:case N.STRING:return pt.LengthDelimited;case N.DOUBLE:case N.FIXED64:case N.SFIXED64:return pt.Bit64;case N.FIXED32:case N.SFIXED32:case N.FLOAT:return pt.Bit32;default:return pt.Varint}}function Fu(n){return Object.assign(Object.assign({readUnknownFields:!0,recursionLimit:100},n),{depth:0})}function jn(n,e,t){let i=vt(n);return Uu(n).read(i,new Vn(e),Fu(t),e.byteLength),i}var Tf=new WeakMap;function Uu(n){let e=Tf.get(n);return e===void 0&&(e=Wx(n)),e}function Wx(n){let e=String(n),t=new Map,i={read:zx(e,t),readGroup:Xx(e,t)};Tf.set(n,i);for(let s of n.fields)t.set(s.number,If(s));return i}function zx(n,e){return(t,i,s,r)=>{var o;if(++s.depth>s.recursionLimit)throw new Error(`cannot decode ${n} from binary: maximum recursion depth of ${s.recursionLimit} reached`);let a=i.pos+r,l=(o=t.$unknown)!==null&&o!==void 0?o:[];for(;i.pos<a;){let[c,u]=i.tag(),h=e.get(c);if(h===void 0){let p=i.skip(u,c,s.recursionLimit-s.depth);s.readUnknownFields&&l.push({no:c,wireType:u,data:p});continue}h(t,i,s,u)}l.length>0&&(t.$unknown=l),s.depth--}}function Xx(n,e){return(t,i,s,r)=>{var o;if(++s.depth>s.recursionLimit)throw new Error(`cannot decode ${n} from binary: maximum recursion depth of ${s.recursionLimit} reached`);let a,l,c=(o=t.$unknown)!==null&&o!==void 0?o:[];for(;i.pos<i.len&&([a,l]=i.tag(),l!=pt.EndGroup);){let u=e.get(a);if(u===void 0){let h=i.skip(l,a,s.recursionLimit-s.depth);s.readUnknownFields&&c.push({no:a,wireType:l,data:h});continue}u(t,i,s,l)}if(l!=pt.EndGroup||a!==r)throw new Error("invalid end group tag");c.length>0&&(t.$unknown=c),s.depth--}}function Cf(n,e,t,i,s){If(t)(n[Vt],e,s,i)}function If(n){switch(n.fieldKind){case"scalar":return Zx(n);case"enum":return Hx(n);case"message":return Yx(n);case"list":return Jx(n);case"map":return Qx(n)}}function Zx(n){let e=Ma(n.scalar,n.utf8Validation,n.longAsString),t=n.localName;if(n.oneof){let i=n.oneof.localName;return(s,r)=>{s[i]={case:t,value:e(r)}}}return(i,s)=>{i[t]=e(s)}}function Hx(n){var e;let t=n.localName,i=(e=n.oneof)===null||e===void 0?void 0:e.localName;if(n.enum.open)return i!==void 0?(o,a)=>{o[i]={case:t,value:a.int32()}}:(o,a)=>{o[t]=a.int32()};let s=n.enum.values,r=n.number;return(o,a,l,c)=>{var u;let h=a.int32();if(s.some(p=>p.number===h))i!==void 0?o[i]={case:t,value:h}:o[t]=h;else if(l.readUnknownFields){let p=[];Xp(h,p);let d=(u=o.$unknown)!==null&&u!==void 0?u:[];d.push({no:r,wireType:c,data:new Uint8Array(p)}),o.$unknown=d}}}function Yx(n){let e=n.localName,{toMessage:t,toLocal:i}=_n(n),s=Nf(n);if(n.oneof){let r=n.oneof.localName;return(o,a,l)=>{let c=o[r],u=t(c.case===e?c.value:void 0);s(u,a,l),o[r]={case:e,value:i(u)}}}return(r,o,a)=>{let l=t(r[e]);s(l,o,a),r[e]=i(l)}}function Nf(n){let e=Uu(n.message);if(n.delimitedEncoding){let t=n.number;return(i,s,r)=>e.readGroup(i,s,r,t)}return(t,i,s)=>e.read(t,i,s,i.uint32())}function Jx(n){let e=n.localName;if(n.listKind=="message"){let{toMessage:o,toLocal:a}=_n(n),l=Nf(n);return(c,u,h)=>{let p=o(void 0);l(p,u,h),c[e].push(a(p))}}let t=n.listKind=="enum"?N.INT32:n.scalar,i=n.listKind=="scalar"?n.longAsString:!1,s=Ma(t,n.utf8Validation,i),r=t!=N.STRING&&t!=N.BYTES;return(o,a,l,c)=>{let u=o[e];if(c==pt.LengthDelimited&&r){let h=a.uint32()+a.pos;for(;a.pos<h;)u.push(s(a))}else u.push(s(a))}}function Qx(n){let e=n.localName,t=Ma(n.mapKey,n.utf8Validation,!1),i=sn(n.mapKey,!1),s,r;switch(n.mapKind){case"scalar":{let o=n.scalar,a=Ma(o,n.utf8Validation,!1);if(s=l=>a(l),o==N.BYTES)r=()=>new Uint8Array(0);else{let l=sn(o,!1);r=()=>l}break}case"enum":{let o=n.enum.values[0].number;s=a=>a.int32(),r=()=>o;break}case"message":{let{toMessage:o,toLocal:a}=_n(n),l=Uu(n.message).read;s=(c,u,h)=>{let p=o(h);return l(p,c,u,c.uint32()),a(p)},r=()=>a(o(void 0));break}}return(o,a,l)=>{let c=o[e],u,h,p=a.uint32(),d=a.pos+p;for(;a.pos<d;){let[f,b]=a.tag();switch(f){case 1:u=t(a);break;case 2:h=s(a,l,h);break;default:a.skip(b,f,l.recursionLimit-l.depth)}}u===void 0&&(u=i),h===void 0&&(h=r()),jt(c,u,h)}}function Ma(n,e,t){switch(n){case N.STRING:return i=>i.string(e);case N.BOOL:return i=>i.bool();case N.DOUBLE:return i=>i.double();case N.FLOAT:return i=>i.float();case N.INT32:return i=>i.int32();case N.INT64:return t?i=>String(i.int64()):i=>i.int64();case N.UINT64:return t?i=>String(i.uint64()):i=>i.uint64();case N.FIXED64:return t?i=>String(i.fixed64()):i=>i.fixed64();case N.BYTES:return i=>i.bytes();case N.FIXED32:return i=>i.fixed32();case N.SFIXED32:return i=>i.sfixed32();case N.SFIXED64:return t?i=>String(i.sfixed64()):i=>i.sfixed64();case N.SINT64:return t?i=>String(i.sint64()):i=>i.sint64();case N.UINT32:return i=>i.uint32();case N.SINT32:return i=>i.sint32()}}var Ae;(function(n){n[n.Canceled=1]="Canceled",n[n.Unknown=2]="Unknown",n[n.InvalidArgument=3]="InvalidArgument",n[n.DeadlineExceeded=4]="DeadlineExceeded",n[n.NotFound=5]="NotFound",n[n.AlreadyExists=6]="AlreadyExists",n[n.PermissionDenied=7]="PermissionDenied",n[n.ResourceExhausted=8]="ResourceExhausted",n[n.FailedPrecondition=9]="FailedPrecondition",n[n.Aborted=10]="Aborted",n[n.OutOfRange=11]="OutOfRange",n[n.Unimplemented=12]="Unimplemented",n[n.Internal=13]="Internal",n[n.Unavailable=14]="Unavailable",n[n.DataLoss=15]="DataLoss",n[n.Unauthenticated=16]="Unauthenticated"})(Ae||(Ae={}));function Ra(n,e){let t=n.fieldKind=="list"?Xr(e,n):n.fieldKind=="map"?Zr(e,n):Du(n,e);if(t===!0)return;let i;switch(n.fieldKind){case"list":i=`expected ${Ff(n)}, got ${Ct(e)}`;break;case"map":i=`expected ${Uf(n)}, got ${Ct(e)}`;break;default:i=On(n,e,t)}return new et(n,i)}function Pu(n,e,t){let i=Du(n,t);if(i!==!0)return new et(n,`list item #${e+1}: ${On(n,t,i)}`)}function Bf(n,e,t){let i=Ai(n.mapKey)(e);if(i!==!0)return new et(n,`invalid map key: ${On({scalar:n.mapKey},e,i)}`);let s=Du(n,t);if(s!==!0)return new et(n,`map entry ${Ct(e)}: ${On(n,t,s)}`)}function Du(n,e){return n.scalar!==void 0?Ai(n.scalar)(e):n.enum!==void 0?n.enum.open?Ai(N.INT32)(e):n.enum.values.some(t=>t.number===e):Hr(e,n.message)}function Ai(n){switch(n){case N.DOUBLE:return e=>typeof e=="number";case N.FLOAT:return e=>typeof e!="number"?!1:!Number.isFinite(Math.fround(e))&&Number.isFinite(e)?`${e.toFixed()} out of range`:!0;case N.INT32:case N.SFIXED32:case N.SINT32:return e=>typeof e!="number"||!Number.isInteger(e)?!1:e>Cu||e<Iu?`${e.toFixed()} out of range`:!0;case N.FIXED32:case N.UINT32:return e=>typeof e!="number"||!Number.isInteger(e)?!1:e>Tu||e<0?`${e.toFixed()} out of range`:!0;case N.BOOL:return e=>typeof e=="boolean";case N.STRING:return e=>typeof e!="string"?!1:kr().checkUtf8(e)||"invalid UTF8";case N.BYTES:return e=>e instanceof Uint8Array;case N.INT64:case N.SFIXED64:case N.SINT64:return e=>{if(typeof e=="bigint"||typeof e=="number"||typeof e=="string"&&e.length>0)try{return $e.parse(e),!0}catch{return`${e} out of range`}return!1};case N.FIXED64:case N.UINT64:return e=>{if(typeof e=="bigint"||typeof e=="number"||typeof e=="string"&&e.length>0)try{return $e.uParse(e),!0}catch{return`${e} out of range`}return!1}}}function On(n,e,t){return t=typeof t=="string"?`: ${t}`:`, got ${Ct(e)}`,n.scalar!==void 0?`expected ${Kx(n.scalar)}`+t:n.enum!==void 0?`expected ${n.enum.toString()}`+t:`expected ${Lf(n.message)}`+t}function Ct(n){switch(typeof n){case"object":return n===null?"null":n instanceof Uint8Array?`Uint8Array(${n.length})`:Array.isArray(n)?`Array(${n.length})`:Xr(n)?Ff(n.field()):Zr(n)?Uf(n.field()):Hr(n)?Lf(n.desc):zr(n)?`message ${n.$typeName}`:"object";case"string":return n.length>30?"string":`"${n.split('"').join('\\"')}"`;case"boolean":return String(n);case"number":return String(n);case"bigint":return String(n)+"n";default:return typeof n}}function Lf(n){return`ReflectMessage (${n.typeName})`}function Ff(n){switch(n.listKind){case"message":return`ReflectList (${n.message.toString()})`;case"enum":return`ReflectList (${n.enum.toString()})`;case"scalar":return`ReflectList (${N[n.scalar]})`}}function Uf(n){switch(n.mapKind){case"message":return`ReflectMap (${N[n.mapKey]}, ${n.message.toString()})`;case"enum":return`ReflectMap (${N[n.mapKey]}, ${n.enum.toString()})`;case"scalar":return`ReflectMap (${N[n.mapKey]}, ${N[n.scalar]})`}}function Kx(n){switch(n){case N.STRING:return"string";case N.BOOL:return"boolean";case N.INT64:case N.SINT64:case N.SFIXED64:return"bigint (int64)";case N.UINT64:case N.FIXED64:return"bigint (uint64)";case N.BYTES:return"Uint8Array";case N.DOUBLE:return"number (float64)";case N.FLOAT:return"number (float32)";case N.FIXED32:case N.UINT32:return"number (uint32)";case N.INT32:case N.SFIXED32:case N.SINT32:return"number (int32)"}}function Vf(n,e,t=!0){return new Ta(n,e,t)}var Pf=new WeakMap,Ta=class{get sortedFields(){let e=Pf.get(this.desc);if(e)return e;let t=this.desc.fields.concat().sort((i,s)=>i.number-s.number);return Pf.set(this.desc,t),t}constructor(e,t,i=!0){this.lists=new Map,this.maps=new Map,this.check=i,this.desc=e,this.message=this[Vt]=t??vt(e),this.fields=e.fields,this.oneofs=e.oneofs,this.members=e.members}findNumber(e){return this._fieldsByNumber||(this._fieldsByNumber=new Map(this.desc.fields.map(t=>[t.number,t]))),this._fieldsByNumber.get(e)}oneofCase(e){return Jr(this.message,e),af(this.message,e)}isSet(e){return Jr(this.message,e),lf(this.message,e)}clear(e){Jr(this.message,e),hf(this.message,e)}get(e){Jr(this.message,e);let t=cf(this.message,e);switch(e.fieldKind){case"list":let i=this.lists.get(e);return(!i||i[Vt]!==t)&&this.lists.set(e,i=new Ou(e,t,this.check)),i;case"map":let s=this.maps.get(e);return(!s||s[Vt]!==t)&&this.maps.set(e,s=new ku(e,t,this.check)),s;case"message":return zu(e,t,this.check);case"scalar":return t===void 0?sn(e.scalar,!1):Xu(e,t);case"enum":return t??e.enum.values[0].number}}set(e,t){if(Jr(this.message,e),this.check){let s=Ra(e,t);if(s)throw s}let i;e.fieldKind=="message"?i=Wu(e,t):Zr(t)||Xr(t)?i=t[Vt]:i=Zu(e,t),uf(this.message,e,i)}getUnknown(){return this.message.$unknown}setUnknown(e){this.message.$unknown=e}};function Jr(n,e){if(e.parent.typeName!==n.$typeName)throw new et(e,`cannot use ${e.toString()} with message ${n.$typeName}`,"ForeignFieldError")}var Ou=class{field(){return this._field}get size(){return this._arr.length}constructor(e,t,i){this._field=e,this._arr=this[Vt]=t,this.check=i}get(e){let t=this._arr[e];return t===void 0?void 0:Gu(this._field,t,this.check)}set(e,t){if(e<0||e>=this._arr.length)throw new et(this._field,`list item #${e+1}: out of range`);if(this.check){let i=Pu(this._field,e,t);if(i)throw i}this._arr[e]=Df(this._field,t)}add(e){if(this.check){let t=Pu(this._field,this._arr.length,e);if(t)throw t}this._arr.push(Df(this._field,e))}clear(){this._arr.splice(0,this._arr.length)}[Symbol.iterator](){return this.values()}keys(){return this._arr.keys()}*values(){for(let e of this._arr)yield Gu(this._field,e,this.check)}*entries(){for(let e=0;e<this._arr.length;e++)yield[e,Gu(this._field,this._arr[e],this.check)]}};var ku=class{constructor(e,t,i=!0){this.obj=this[Vt]=t??{},this.check=i,this._field=e}field(){return this._field}set(e,t){if(this.check){let i=Bf(this._field,e,t);if(i)throw i}return jt(this.obj,wa(e),qx(this._field,t)),this}delete(e){let t=wa(e),i=Object.prototype.hasOwnProperty.call(this.obj,t);return i&&delete this.obj[t],i}clear(){for(let e of Object.keys(this.obj))delete this.obj[e]}get(e){let t=df(this.obj,wa(e));return t!==void 0&&(t=Vu(this._field,t,this.check)),t}has(e){return Object.prototype.hasOwnProperty.call(this.obj,wa(e))}*keys(){for(let e of Object.keys(this.obj))yield Gf(e,this._field.mapKey)}*entries(){for(let e of Object.entries(this.obj))yield[Gf(e[0],this._field.mapKey),Vu(this._field,e[1],this.check)]}[Symbol.iterator](){return this.entries()}get size(){return Object.keys(this.obj).length}*values(){for(let e of Object.values(this.obj))yield Vu(this._field,e,this.check)}forEach(e,t){for(let i of this.entries())e.call(t,i[1],i[0],this)}};function Wu(n,e){return Hr(e)?pf(e.message)&&!n.oneof&&n.fieldKind=="message"?e.message.value:e.desc.typeName=="google.protobuf.Struct"&&n.parent.typeName!="google.protobuf.Value"?_a(e.message):e.message:e}function zu(n,e,t){return e!==void 0&&(Tn(n.message)&&!n.oneof&&n.fieldKind=="message"?e={$typeName:n.message.typeName,value:Xu(n.message.fields[0],e)}:n.message.typeName=="google.protobuf.Struct"&&n.parent.typeName!="google.protobuf.Value"&&qn(e)&&(e=Sa(e))),new Ta(n.message,e,t)}function Df(n,e){return n.listKind=="message"?Wu(n,e):Zu(n,e)}function Gu(n,e,t){return n.listKind=="message"?zu(n,e,t):Xu(n,e)}function qx(n,e){return n.mapKind=="message"?Wu(n,e):Zu(n,e)}function Vu(n,e,t){return n.mapKind=="message"?zu(n,e,t):e}function wa(n){return typeof n=="string"||typeof n=="number"?n:String(n)}function Gf(n,e){switch(e){case N.STRING:return n;case N.INT32:case N.FIXED32:case N.UINT32:case N.SFIXED32:case N.SINT32:{let t=Number.parseInt(n);if(Number.isFinite(t))return t;break}case N.BOOL:switch(n){case"true":return!0;case"false":return!1}break;case N.UINT64:case N.FIXED64:try{return $e.uParse(n)}catch{}break;default:try{return $e.parse(n)}catch{}break}return n}function Xu(n,e){switch(n.scalar){case N.INT64:case N.SFIXED64:case N.SINT64:"longAsString"in n&&n.longAsString&&typeof e=="string"&&(e=$e.parse(e));break;case N.FIXED64:case N.UINT64:"longAsString"in n&&n.longAsString&&typeof e=="string"&&(e=$e.uParse(e));break}return e}function Zu(n,e){switch(n.scalar){case N.INT64:case N.SFIXED64:case N.SINT64:"longAsString"in n&&n.longAsString?e=String(e):(typeof e=="string"||typeof e=="number")&&(e=$e.parse(e));break;case N.FIXED64:case N.UINT64:"longAsString"in n&&n.longAsString?e=String(e):(typeof e=="string"||typeof e=="number")&&(e=$e.uParse(e));break}return e}function Mi(n){let e=!1,t=[];for(let i=0;i<n.length;i++){let s=n.charAt(i);switch(s){case"_":e=!0;break;case"0":case"1":case"2":case"3":case"4":case"5":case"6":case"7":case"8":case"9":t.push(s),e=!1;break;default:e&&(e=!1,s=s.toUpperCase()),t.push(s);break}}return t.join("")}function Ca(n){return n.replace(/[A-Z]/g,e=>"_"+e.toLowerCase())}var jx=new Set(["constructor","toString","toJSON","valueOf"]);function Os(n){return jx.has(n)?n+"$":n}function Qr(n){for(let e of n.field)fs(e,"jsonName")||(e.jsonName=Mi(e.name));n.nestedType.forEach(Qr)}function*Ia(n){switch(n.kind){case"file":for(let e of n.messages)yield e,yield*Ia(e);yield*n.enums,yield*n.services,yield*n.extensions;break;case"message":for(let e of n.nestedMessages)yield e,yield*Ia(e);yield*n.nestedEnums,yield*n.nestedExtensions;break}}function Na(n,e){return $x([n,e])}function $x(n,e){let t=ev();if(!n.length)return t;if("$typeName"in n[0]&&n[0].$typeName=="google.protobuf.FileDescriptorSet"){for(let i of n[0].file)e?.(i),zf(i,t);return t}if("$typeName"in n[0]){let o=function(a){let l=[];for(let c of a.dependency){if(t.getFile(c)!=null||r.has(c))continue;let u=s(c);if(!u)throw new Error(`Unable to resolve ${c}, imported by ${a.name}`);"kind"in u?t.addFile(u,!1,!0):(r.add(u.name),l.push(u))}return l.concat(...l.map(o))},i=n[0],s=n[1],r=new Set;for(let a of[i,...o(i)].reverse())e?.(a),zf(a,t)}else for(let i of n)for(let s of i.files)t.addFile(s);return t}function ev(){let n=new Map,e=new Map,t=new Map;return{kind:"registry",types:n,extendees:e,[Symbol.iterator](){return n.values()},get files(){return t.values()},addFile(i,s,r){if(t.set(i.proto.name,i),!s)for(let o of Ia(i))this.add(o);if(r)for(let o of i.dependencies)this.addFile(o,s,r)},add(i){if(i.kind=="extension"){let s=e.get(i.extendee.typeName);s||e.set(i.extendee.typeName,s=new Map),s.set(i.number,i)}n.set(i.typeName,i)},get(i){return n.get(i)},getFile(i){return t.get(i)},getMessage(i){let s=n.get(i);return s?.kind=="message"?s:void 0},getEnum(i){let s=n.get(i);return s?.kind=="enum"?s:void 0},getExtension(i){let s=n.get(i);return s?.kind=="extension"?s:void 0},getExtensionFor(i,s){var r;return(r=e.get(i.typeName))===null||r===void 0?void 0:r.get(s)},getService(i){let s=n.get(i);return s?.kind=="service"?s:void 0}}}var tv=998,nv=999,iv=9999,sv=9,qr=10,Kr=11,rv=12,Of=14,Ku=3,ov=2,kf=1,av=0,Hu=1,Wf=2,lv=3,cv=1,uv=2,dv=1,hv=2;var pv=1002,Zf={998:{fieldPresence:1,enumType:2,repeatedFieldEncoding:2,utf8Validation:3,messageEncoding:1,jsonFormat:2,enforceNamingStyle:2,defaultSymbolVisibility:1,enforceProtoLimits:1},999:{fieldPresence:2,enumType:1,repeatedFieldEncoding:1,utf8Validation:2,messageEncoding:1,jsonFormat:1,enforceNamingStyle:2,defaultSymbolVisibility:1,enforceProtoLimits:1},1e3:{fieldPresence:1,enumType:1,repeatedFieldEncoding:1,utf8Validation:2,messageEncoding:1,jsonFormat:1,enforceNamingStyle:2,defaultSymbolVisibility:1,enforceProtoLimits:1},1001:{fieldPresence:1,enumType:1,repeatedFieldEncoding:1,utf8Validation:2,messageEncoding:1,jsonFormat:1,enforceNamingStyle:1,defaultSymbolVisibility:2,enforceProtoLimits:1},1002:{fieldPresence:1,enumType:1,repeatedFieldEncoding:1,utf8Validation:2,messageEncoding:1,jsonFormat:1,enforceNamingStyle:3,defaultSymbolVisibility:4,enforceProtoLimits:2}};function zf(n,e){var t,i;let s={kind:"file",proto:n,deprecated:(i=(t=n.options)===null||t===void 0?void 0:t.deprecated)!==null&&i!==void 0?i:!1,edition:yv(n),name:n.name.replace(/\.proto$/,""),dependencies:bv(n,e),enums:[],messages:[],extensions:[],services:[],toString(){return`file ${n.name}`}},r=new Map,o={get(a){return r.get(a)},add(a){var l;$n(((l=a.proto.options)===null||l===void 0?void 0:l.mapEntry)===!0),r.set(a.typeName,a)}};for(let a of n.enumType)Hf(a,s,void 0,e);for(let a of n.messageType)Yf(a,s,void 0,e,o);for(let a of n.service)fv(a,s,e);Yu(s,e);for(let a of r.values())Ju(a,e,o);for(let a of s.messages)Ju(a,e,o),Yu(a,e);e.addFile(s,!0)}function Yu(n,e){switch(n.kind){case"file":for(let t of n.proto.extension){let i=Qu(t,n,e);n.extensions.push(i),e.add(i)}break;case"message":for(let t of n.proto.extension){let i=Qu(t,n,e);n.nestedExtensions.push(i),e.add(i)}for(let t of n.nestedMessages)Yu(t,e);break}}function Ju(n,e,t){let i=n.proto.oneofDecl.map(r=>gv(r,n)),s=new Set;for(let r of n.proto.field){let o=_v(r,i),a=Qu(r,n,e,o,t);n.fields.push(a),n.field[a.localName]=a,o===void 0?n.members.push(a):(o.fields.push(a),s.has(o)||(s.add(o),n.members.push(o)))}for(let r of i.filter(o=>s.has(o)))n.oneofs.push(r);for(let r of n.nestedMessages)Ju(r,e,t)}function Hf(n,e,t,i){var s,r,o,a,l,c,u,h,p;let d=xv(n.name,n.value),f={kind:"enum",proto:n,deprecated:(r=(s=n.options)===null||s===void 0?void 0:s.deprecated)!==null&&r!==void 0?r:!1,file:e,parent:t,open:!0,name:n.name,typeName:Ba(n,t,e),value:{},values:[],sharedPrefix:d,toString(){return`enum ${this.typeName}`}};f.open=Rv(f),i.add(f);for(let b of n.value){let g=b.name,m={kind:"enum_value",proto:b,deprecated:(a=(o=b.options)===null||o===void 0?void 0:o.deprecated)!==null&&a!==void 0?a:!1,parent:f,name:g,localName:Os(d==null?g:g.substring(d.length)),number:b.number,jsonName:(l=vv(b))!==null&&l!==void 0?l:g,toString(){return`enum value ${f.typeName}.${g}`}};f.values.push(m),(c=(h=f.value)[p=b.number])!==null&&c!==void 0||(h[p]=m)}((u=t?.nestedEnums)!==null&&u!==void 0?u:e.enums).push(f)}function Yf(n,e,t,i,s){var r,o,a,l;let c={kind:"message",proto:n,deprecated:(o=(r=n.options)===null||r===void 0?void 0:r.deprecated)!==null&&o!==void 0?o:!1,file:e,parent:t,name:n.name,typeName:Ba(n,t,e),fields:[],field:{},oneofs:[],members:[],nestedEnums:[],nestedMessages:[],nestedExtensions:[],toString(){return`message ${this.typeName}`}};((a=n.options)===null||a===void 0?void 0:a.mapEntry)===!0?s.add(c):(((l=t?.nestedMessages)!==null&&l!==void 0?l:e.messages).push(c),i.add(c));for(let u of n.enumType)Hf(u,e,c,i);for(let u of n.nestedType)Yf(u,e,c,i,s)}function fv(n,e,t){var i,s;let r={kind:"service",proto:n,deprecated:(s=(i=n.options)===null||i===void 0?void 0:i.deprecated)!==null&&s!==void 0?s:!1,file:e,name:n.name,typeName:Ba(n,void 0,e),methods:[],method:{},toString(){return`service ${this.typeName}`}};e.services.push(r),t.add(r);for(let o of n.method){let a=mv(o,r,t);r.methods.push(a),r.method[a.localName]=a}}function mv(n,e,t){var i,s,r,o;let a;n.clientStreaming&&n.serverStreaming?a="bidi_streaming":n.clientStreaming?a="client_streaming":n.serverStreaming?a="server_streaming":a="unary";let l=t.getMessage(Ri(n.inputType)),c=t.getMessage(Ri(n.outputType));$n(l,`invalid MethodDescriptorProto: input_type ${n.inputType} not found`),$n(c,`invalid MethodDescriptorProto: output_type ${n.inputType} not found`);let u=n.name;return{kind:"rpc",proto:n,deprecated:(s=(i=n.options)===null||i===void 0?void 0:i.deprecated)!==null&&s!==void 0?s:!1,parent:e,name:u,localName:Os(u.length?Os(u[0].toLowerCase()+u.substring(1)):u),methodKind:a,input:l,output:c,idempotency:(o=(r=n.options)===null||r===void 0?void 0:r.idempotencyLevel)!==null&&o!==void 0?o:av,toString(){return`rpc ${e.typeName}.${u}`}}}function gv(n,e){return{kind:"oneof",proto:n,deprecated:!1,parent:e,fields:[],name:n.name,localName:Os(Mi(n.name)),toString(){return`oneof ${e.typeName}.${this.name}`}}}function Qu(n,e,t,i,s){var r,o,a;let l=s===void 0,c={kind:"field",proto:n,deprecated:(o=(r=n.options)===null||r===void 0?void 0:r.deprecated)!==null&&o!==void 0?o:!1,name:n.name,number:n.number,scalar:void 0,message:void 0,enum:void 0,presence:Ev(n,i,l,e),utf8Validation:wv(n,e),listKind:void 0,mapKind:void 0,mapKey:void 0,delimitedEncoding:void 0,packed:void 0,longAsString:!1,getDefaultValue:void 0},u;if(l){let f=e.kind=="file"?e:e.file,b=e.kind=="file"?void 0:e,g=Ba(n,b,f);c.kind="extension",c.file=f,c.parent=b,c.oneof=void 0,c.typeName=g,c.jsonName=`[${g}]`,u=()=>`extension ${g}`;let m=t.getMessage(Ri(n.extendee));$n(m,`invalid FieldDescriptorProto: extendee ${n.extendee} not found`),c.extendee=m}else{let f=e;$n(f.kind=="message"),c.parent=f,c.oneof=i,c.localName=i?Mi(n.name):Os(Mi(n.name)),c.jsonName=n.jsonName,u=()=>`field ${f.typeName}.${n.name}`}Object.defineProperty(c,"toString",{value:u,writable:!0,enumerable:!0,configurable:!0});let h=n.label,p=n.type,d=(a=n.options)===null||a===void 0?void 0:a.jstype;if(h===Ku){let f=p==Kr?s?.get(Ri(n.typeName)):void 0;if(f){c.fieldKind="map";let{key:b,value:g}=Mv(f);return c.mapKey=b.scalar,c.mapKind=g.fieldKind,c.message=g.message,c.delimitedEncoding=!1,c.enum=g.enum,c.scalar=g.scalar,c}switch(c.fieldKind="list",p){case Kr:case qr:c.listKind="message",c.message=t.getMessage(Ri(n.typeName)),$n(c.message),c.delimitedEncoding=Xf(n,e);break;case Of:c.listKind="enum",c.enum=t.getEnum(Ri(n.typeName)),$n(c.enum);break;default:c.listKind="scalar",c.scalar=p,c.longAsString=d==kf;break}return c.packed=Av(n,e),c}switch(p){case Kr:case qr:c.fieldKind="message",c.message=t.getMessage(Ri(n.typeName)),$n(c.message,`invalid FieldDescriptorProto: type_name ${n.typeName} not found`),c.delimitedEncoding=Xf(n,e),c.getDefaultValue=()=>{};break;case Of:{let f=t.getEnum(Ri(n.typeName));$n(f!==void 0,`invalid FieldDescriptorProto: type_name ${n.typeName} not found`),c.fieldKind="enum",c.enum=t.getEnum(Ri(n.typeName)),c.getDefaultValue=()=>fs(n,"defaultValue")?tf(f,n.defaultValue):void 0;break}default:{c.fieldKind="scalar",c.scalar=p,c.longAsString=d==kf,c.getDefaultValue=()=>fs(n,"defaultValue")?nf(p,n.defaultValue):void 0;break}}return c}function yv(n){switch(n.syntax){case"":case"proto2":return tv;case"proto3":return nv;case"editions":if(n.edition===iv)return pv;if(n.edition in Zf)return n.edition;throw new Error(`${n.name}: unsupported edition`);default:throw new Error(`${n.name}: unsupported syntax "${n.syntax}"`)}}function bv(n,e){return n.dependency.map(t=>{let i=e.getFile(t);if(!i)throw new Error(`Cannot find ${t}, imported by ${n.name}`);return i})}function xv(n,e){let t=Sv(n)+"_";for(let i of e){if(!i.name.toLowerCase().startsWith(t))return;let s=i.name.substring(t.length);if(s.length==0||/^\d/.test(s))return}return t}function vv(n){var e,t;let r;for(let o of(t=(e=n.options)===null||e===void 0?void 0:e.$unknown)!==null&&t!==void 0?t:[]){if(o.no!==998||o.wireType!==pt.LengthDelimited)continue;let a=new Vn(new Vn(o.data).bytes());for(;a.pos<a.len;){let[l,c]=a.tag();l===1&&c===pt.LengthDelimited?r=a.string():a.skip(c,l)}}return r}function Sv(n){return(n.substring(0,1)+n.substring(1).replace(/[A-Z]/g,e=>"_"+e)).toLowerCase()}function Ba(n,e,t){let i;return e?i=`${e.typeName}.${n.name}`:t.proto.package.length>0?i=`${t.proto.package}.${n.name}`:i=`${n.name}`,i}function Ri(n){return n.startsWith(".")?n.substring(1):n}function _v(n,e){if(!fs(n,"oneofIndex")||n.proto3Optional)return;let t=e[n.oneofIndex];return $n(t,`invalid FieldDescriptorProto: oneof #${n.oneofIndex} for field #${n.number} not found`),t}function Ev(n,e,t,i){if(n.label==ov)return lv;if(n.label==Ku)return Wf;if(e||n.proto3Optional||t)return Hu;let s=ms("fieldPresence",{proto:n,parent:i});return s==Wf&&(n.type==Kr||n.type==qr)?Hu:s}function Av(n,e){if(n.label!=Ku)return!1;switch(n.type){case sv:case rv:case qr:case Kr:return!1}let t=n.options;return t&&fs(t,"packed")?t.packed:cv==ms("repeatedFieldEncoding",{proto:n,parent:e})}function Mv(n){let e=n.fields.find(i=>i.number===1),t=n.fields.find(i=>i.number===2);return $n(e&&e.fieldKind=="scalar"&&e.scalar!=N.BYTES&&e.scalar!=N.FLOAT&&e.scalar!=N.DOUBLE&&t&&t.fieldKind!="list"&&t.fieldKind!="map"),{key:e,value:t}}function Rv(n){var e;return dv==ms("enumType",{proto:n.proto,parent:(e=n.parent)!==null&&e!==void 0?e:n.file})}function Xf(n,e){return n.type==qr?!0:uv==ms("messageEncoding",{proto:n,parent:e})}function wv(n,e){return hv==ms("utf8Validation",{proto:n,parent:e})}function ms(n,e){var t,i;let s=(t=e.proto.options)===null||t===void 0?void 0:t.features;if(s){let r=s[n];if(r!=0)return r}if("kind"in e){if(e.kind=="message")return ms(n,(i=e.parent)!==null&&i!==void 0?i:e.file);let r=Zf[e.edition];if(!r)throw new Error(`feature default for edition ${e.edition} not found`);return r[n]}return ms(n,e.parent)}function $n(n,e){if(!n)throw new Error(e)}function Jf(n){let e=Tv(n);return e.messageType.forEach(Qr),Na(e,()=>{}).getFile(e.name)}function Tv(n){return Object.assign(Object.create({syntax:"",edition:0}),Object.assign(Object.assign({$typeName:"google.protobuf.FileDescriptorProto",dependency:[],publicDependency:[],weakDependency:[],optionDependency:[],service:[],extension:[]},n),{messageType:n.messageType.map(Qf),enumType:n.enumType.map(Kf)}))}function Qf(n){var e,t,i,s,r,o,a,l;return Object.assign(Object.create({visibility:0}),{$typeName:"google.protobuf.DescriptorProto",name:n.name,field:(t=(e=n.field)===null||e===void 0?void 0:e.map(Cv))!==null&&t!==void 0?t:[],extension:[],nestedType:(s=(i=n.nestedType)===null||i===void 0?void 0:i.map(Qf))!==null&&s!==void 0?s:[],enumType:(o=(r=n.enumType)===null||r===void 0?void 0:r.map(Kf))!==null&&o!==void 0?o:[],extensionRange:(l=(a=n.extensionRange)===null||a===void 0?void 0:a.map(u=>Object.assign({$typeName:"google.protobuf.DescriptorProto.ExtensionRange"},u)))!==null&&l!==void 0?l:[],oneofDecl:[],reservedRange:[],reservedName:[]})}function Cv(n){return Object.assign(Object.create({label:1,typeName:"",extendee:"",defaultValue:"",oneofIndex:0,jsonName:"",proto3Optional:!1}),Object.assign(Object.assign({$typeName:"google.protobuf.FieldDescriptorProto"},n),{options:n.options?Iv(n.options):void 0}))}function Iv(n){var e,t,i;return Object.assign(Object.create({ctype:0,packed:!1,jstype:0,lazy:!1,unverifiedLazy:!1,deprecated:!1,weak:!1,debugRedact:!1,retention:0}),Object.assign(Object.assign({$typeName:"google.protobuf.FieldOptions"},n),{targets:(e=n.targets)!==null&&e!==void 0?e:[],editionDefaults:(i=(t=n.editionDefaults)===null||t===void 0?void 0:t.map(r=>Object.assign({$typeName:"google.protobuf.FieldOptions.EditionDefault"},r)))!==null&&i!==void 0?i:[],uninterpretedOption:[]}))}function Kf(n){return Object.assign(Object.create({visibility:0}),{$typeName:"google.protobuf.EnumDescriptorProto",name:n.name,reservedName:[],reservedRange:[],value:n.value.map(t=>Object.assign({$typeName:"google.protobuf.EnumValueDescriptorProto"},t))})}function rt(n,e,...t){return t.reduce((i,s)=>i.nestedMessages[s],n.messages[e])}var gs=Jf({name:"google/protobuf/descriptor.proto",package:"google.protobuf",messageType:[{name:"FileDescriptorSet",field:[{name:"file",number:1,type:11,label:3,typeName:".google.protobuf.FileDescriptorProto"}],extensionRange:[{start:536e6,end:536000001}]},{name:"FileDescriptorProto",field:[{name:"name",number:1,type:9,label:1},{name:"package",number:2,type:9,label:1},{name:"dependency",number:3,type:9,label:3},{name:"public_dependency",number:10,type:5,label:3},{name:"weak_dependency",number:11,type:5,label:3},{name:"option_dependency",number:15,type:9,label:3},{name:"message_type",number:4,type:11,label:3,typeName:".google.protobuf.DescriptorProto"},{name:"enum_type",number:5,type:11,label:3,typeName:".google.protobuf.EnumDescriptorProto"},{name:"service",number:6,type:11,label:3,typeName:".google.protobuf.ServiceDescriptorProto"},{name:"extension",number:7,type:11,label:3,typeName:".google.protobuf.FieldDescriptorProto"},{name:"options",number:8,type:11,label:1,typeName:".google.protobuf.FileOptions"},{name:"source_code_info",number:9,type:11,label:1,typeName:".google.protobuf.SourceCodeInfo"},{name:"syntax",number:12,type:9,label:1},{name:"edition",number:14,type:14,label:1,typeName:".google.protobuf.Edition"}]},{name:"DescriptorProto",field:[{name:"name",number:1,type:9,label:1},{name:"field",number:2,type:11,label:3,typeName:".google.protobuf.FieldDescriptorProto"},{name:"extension",number:6,type:11,label:3,typeName:".google.protobuf.FieldDescriptorProto"},{name:"nested_type",number:3,type:11,label:3,typeName:".google.protobuf.DescriptorProto"},{name:"enum_type",number:4,type:11,label:3,typeName:".google.protobuf.EnumDescriptorProto"},{name:"extension_range",number:5,type:11,label:3,typeName:".google.protobuf.DescriptorProto.ExtensionRange"},{name:"oneof_decl",number:8,type:11,label:3,typeName:".google.protobuf.OneofDescriptorProto"},{name:"options",number:7,type:11,label:1,typeName:".google.protobuf.MessageOptions"},{name:"reserved_range",number:9,type:11,label:3,typeName:".google.protobuf.DescriptorProto.ReservedRange"},{name:"reserved_name",number:10,type:9,label:3},{name:"visibility",number:11,type:14,label:1,typeName:".google.protobuf.SymbolVisibility"}],nestedType:[{name:"ExtensionRange",field:[{name:"start",number:1,type:5,label:1},{name:"end",number:2,type:5,label:1},{name:"options",number:3,type:11,label:1,typeName:".google.protobuf.ExtensionRangeOptions"}]},{name:"ReservedRange",field:[{name:"start",number:1,type:5,label:1},{name:"end",number:2,type:5,label:1}]}]},{name:"ExtensionRangeOptions",field:[{name:"uninterpreted_option",number:999,type:11,label:3,typeName:".google.protobuf.UninterpretedOption"},{name:"declaration",number:2,type:11,label:3,typeName:".google.protobuf.ExtensionRangeOptions.Declaration",options:{retention:2}},{name:"features",number:50,type:11,label:1,typeName:".google.protobuf.FeatureSet"},{name:"verification",number:3,type:14,label:1,typeName:".google.protobuf.ExtensionRangeOptions.VerificationState",defaultValue:"UNVERIFIED",options:{retention:2}}],nestedType:[{name:"Declaration",field:[{name:"number",number:1,type:5,label:1},{name:"full_name",number:2,type:9,label:1},{name:"type",number:3,type:9,label:1},{name:"reserved",number:5,type:8,label:1},{name:"repeated",number:6,type:8,label:1}]}],enumType:[{name:"VerificationState",value:[{name:"DECLARATION",number:0},{name:"UNVERIFIED",number:1}]}],extensionRange:[{start:990,end:999},{start:1e3,end:536870912}]},{name:"FieldDescriptorProto",field:[{name:"name",number:1,type:9,label:1},{name:"number",number:3,type:5,label:1},{name:"label",number:4,type:14,label:1,typeName:".google.protobuf.FieldDescriptorProto.Label"},{name:"type",number:5,type:14,label:1,typeName:".google.protobuf.FieldDescriptorProto.Type"},{name:"type_name",number:6,type:9,label:1},{name:"extendee",number:2,type:9,label:1},{name:"default_value",number:7,type:9,label:1},{name:"oneof_index",number:9,type:5,label:1},{name:"json_name",number:10,type:9,label:1},{name:"options",number:8,type:11,label:1,typeName:".google.protobuf.FieldOptions"},{name:"proto3_optional",number:17,type:8,label:1}],enumType:[{name:"Type",value:[{name:"TYPE_DOUBLE",number:1},{name:"TYPE_FLOAT",number:2},{name:"TYPE_INT64",number:3},{name:"TYPE_UINT64",number:4},{name:"TYPE_INT32",number:5},{name:"TYPE_FIXED64",number:6},{name:"TYPE_FIXED32",number:7},{name:"TYPE_BOOL",number:8},{name:"TYPE_STRING",number:9},{name:"TYPE_GROUP",number:10},{name:"TYPE_MESSAGE",number:11},{name:"TYPE_BYTES",number:12},{name:"TYPE_UINT32",number:13},{name:"TYPE_ENUM",number:14},{name:"TYPE_SFIXED32",number:15},{name:"TYPE_SFIXED64",number:16},{name:"TYPE_SINT32",number:17},{name:"TYPE_SINT64",number:18}]},{name:"Label",value:[{name:"LABEL_OPTIONAL",number:1},{name:"LABEL_REPEATED",number:3},{name:"LABEL_REQUIRED",number:2}]}]},{name:"OneofDescriptorProto",field:[{name:"name",number:1,type:9,label:1},{name:"options",number:2,type:11,label:1,typeName:".google.protobuf.OneofOptions"}]},{name:"EnumDescriptorProto",field:[{name:"name",number:1,type:9,label:1},{name:"value",number:2,type:11,label:3,typeName:".google.protobuf.EnumValueDescriptorProto"},{name:"options",number:3,type:11,label:1,typeName:".google.protobuf.EnumOptions"},{name:"reserved_range",number:4,type:11,label:3,typeName:".google.protobuf.EnumDescriptorProto.EnumReservedRange"},{name:"reserved_name",number:5,type:9,label:3},{name:"visibility",number:6,type:14,label:1,typeName:".google.protobuf.SymbolVisibility"}],nestedType:[{name:"EnumReservedRange",field:[{name:"start",number:1,type:5,label:1},{name:"end",number:2,type:5,label:1}]}]},{name:"EnumValueDescriptorProto",field:[{name:"name",number:1,type:9,label:1},{name:"number",number:2,type:5,label:1},{name:"options",number:3,type:11,label:1,typeName:".google.protobuf.EnumValueOptions"}]},{name:"ServiceDescriptorProto",field:[{name:"name",number:1,type:9,label:1},{name:"method",number:2,type:11,label:3,typeName:".google.protobuf.MethodDescriptorProto"},{name:"options",number:3,type:11,label:1,typeName:".google.protobuf.ServiceOptions"}]},{name:"MethodDescriptorProto",field:[{name:"name",number:1,type:9,label:1},{name:"input_type",number:2,type:9,label:1},{name:"output_type",number:3,type:9,label:1},{name:"options",number:4,type:11,label:1,typeName:".google.protobuf.MethodOptions"},{name:"client_streaming",number:5,type:8,label:1,defaultValue:"false"},{name:"server_streaming",number:6,type:8,label:1,defaultValue:"false"}]},{name:"FileOptions",field:[{name:"java_package",number:1,type:9,label:1},{name:"java_outer_classname",number:8,type:9,label:1},{name:"java_multiple_files",number:10,type:8,label:1,defaultValue:"false",options:{}},{name:"java_generate_equals_and_hash",number:20,type:8,label:1,options:{deprecated:!0}},{name:"java_string_check_utf8",number:27,type:8,label:1,defaultValue:"false"},{name:"optimize_for",number:9,type:14,label:1,typeName:".google.protobuf.FileOptions.OptimizeMode",defaultValue:"SPEED"},{name:"go_package",number:11,type:9,label:1},{name:"cc_generic_services",number:16,type:8,label:1,defaultValue:"false"},{name:"java_generic_services",number:17,type:8,label:1,defaultValue:"false"},{name:"py_generic_services",number:18,type:8,label:1,defaultValue:"false"},{name:"deprecated",number:23,type:8,label:1,defaultValue:"false"},{name:"cc_enable_arenas",number:31,type:8,label:1,defaultValue:"true",options:{}},{name:"objc_class_prefix",number:36,type:9,label:1},{name:"csharp_namespace",number:37,type:9,label:1},{name:"swift_prefix",number:39,type:9,label:1},{name:"php_class_prefix",number:40,type:9,label:1},{name:"php_namespace",number:41,type:9,label:1},{name:"php_metadata_namespace",number:44,type:9,label:1},{name:"ruby_package",number:45,type:9,label:1},{name:"features",number:50,type:11,label:1,typeName:".google.protobuf.FeatureSet"},{name:"uninterpreted_option",number:999,type:11,label:3,typeName:".google.protobuf.UninterpretedOption"}],enumType:[{name:"OptimizeMode",value:[{name:"SPEED",number:1},{name:"CODE_SIZE",number:2},{name:"LITE_RUNTIME",number:3}]}],extensionRange:[{start:990,end:999},{start:1e3,end:536870912}]},{name:"MessageOptions",field:[{name:"message_set_wire_format",number:1,type:8,label:1,defaultValue:"false"},{name:"no_standard_descriptor_accessor",number:2,type:8,label:1,defaultValue:"false"},{name:"deprecated",number:3,type:8,label:1,defaultValue:"false"},{name:"map_entry",number:7,type:8,label:1},{name:"deprecated_legacy_json_field_conflicts",number:11,type:8,label:1,options:{deprecated:!0}},{name:"features",number:12,type:11,label:1,typeName:".google.protobuf.FeatureSet"},{name:"uninterpreted_option",number:999,type:11,label:3,typeName:".google.protobuf.UninterpretedOption"}],extensionRange:[{start:990,end:999},{start:1e3,end:536870912}]},{name:"FieldOptions",field:[{name:"ctype",number:1,type:14,label:1,typeName:".google.protobuf.FieldOptions.CType",defaultValue:"STRING"},{name:"packed",number:2,type:8,label:1},{name:"jstype",number:6,type:14,label:1,typeName:".google.protobuf.FieldOptions.JSType",defaultValue:"JS_NORMAL"},{name:"lazy",number:5,type:8,label:1,defaultValue:"false"},{name:"unverified_lazy",number:15,type:8,label:1,defaultValue:"false"},{name:"deprecated",number:3,type:8,label:1,defaultValue:"false"},{name:"weak",number:10,type:8,label:1,defaultValue:"false",options:{deprecated:!0}},{name:"debug_redact",number:16,type:8,label:1,defaultValue:"false"},{name:"retention",number:17,type:14,label:1,typeName:".google.protobuf.FieldOptions.OptionRetention"},{name:"targets",number:19,type:14,label:3,typeName:".google.protobuf.FieldOptions.OptionTargetType"},{name:"edition_defaults",number:20,type:11,label:3,typeName:".google.protobuf.FieldOptions.EditionDefault"},{name:"features",number:21,type:11,label:1,typeName:".google.protobuf.FeatureSet"},{name:"feature_support",number:22,type:11,label:1,typeName:".google.protobuf.FieldOptions.FeatureSupport"},{name:"uninterpreted_option",number:999,type:11,label:3,typeName:".google.protobuf.UninterpretedOption"}],nestedType:[{name:"EditionDefault",field:[{name:"edition",number:3,type:14,label:1,typeName:".google.protobuf.Edition"},{name:"value",number:2,type:9,label:1}]},{name:"FeatureSupport",field:[{name:"edition_introduced",number:1,type:14,label:1,typeName:".google.protobuf.Edition"},{name:"edition_deprecated",number:2,type:14,label:1,typeName:".google.protobuf.Edition"},{name:"deprecation_warning",number:3,type:9,label:1},{name:"edition_removed",number:4,type:14,label:1,typeName:".google.protobuf.Edition"},{name:"removal_error",number:5,type:9,label:1}]}],enumType:[{name:"CType",value:[{name:"STRING",number:0},{name:"CORD",number:1},{name:"STRING_PIECE",number:2}]},{name:"JSType",value:[{name:"JS_NORMAL",number:0},{name:"JS_STRING",number:1},{name:"JS_NUMBER",number:2}]},{name:"OptionRetention",value:[{name:"RETENTION_UNKNOWN",number:0},{name:"RETENTION_RUNTIME",number:1},{name:"RETENTION_SOURCE",number:2}]},{name:"OptionTargetType",value:[{name:"TARGET_TYPE_UNKNOWN",number:0},{name:"TARGET_TYPE_FILE",number:1},{name:"TARGET_TYPE_EXTENSION_RANGE",number:2},{name:"TARGET_TYPE_MESSAGE",number:3},{name:"TARGET_TYPE_FIELD",number:4},{name:"TARGET_TYPE_ONEOF",number:5},{name:"TARGET_TYPE_ENUM",number:6},{name:"TARGET_TYPE_ENUM_ENTRY",number:7},{name:"TARGET_TYPE_SERVICE",number:8},{name:"TARGET_TYPE_METHOD",number:9}]}],extensionRange:[{start:990,end:999},{start:1e3,end:536870912}]},{name:"OneofOptions",field:[{name:"features",number:1,type:11,label:1,typeName:".google.protobuf.FeatureSet"},{name:"uninterpreted_option",number:999,type:11,label:3,typeName:".google.protobuf.UninterpretedOption"}],extensionRange:[{start:990,end:999},{start:1e3,end:536870912}]},{name:"EnumOptions",field:[{name:"allow_alias",number:2,type:8,label:1},{name:"deprecated",number:3,type:8,label:1,defaultValue:"false"},{name:"deprecated_legacy_json_field_conflicts",number:6,type:8,label:1,options:{deprecated:!0}},{name:"features",number:7,type:11,label:1,typeName:".google.protobuf.FeatureSet"},{name:"uninterpreted_option",number:999,type:11,label:3,typeName:".google.protobuf.UninterpretedOption"}],extensionRange:[{start:990,end:999},{start:1e3,end:536870912}]},{name:"EnumValueOptions",field:[{name:"deprecated",number:1,type:8,label:1,defaultValue:"false"},{name:"features",number:2,type:11,label:1,typeName:".google.protobuf.FeatureSet"},{name:"debug_redact",number:3,type:8,label:1,defaultValue:"false"},{name:"feature_support",number:4,type:11,label:1,typeName:".google.protobuf.FieldOptions.FeatureSupport"},{name:"uninterpreted_option",number:999,type:11,label:3,typeName:".google.protobuf.UninterpretedOption"}],extensionRange:[{start:990,end:999},{start:1e3,end:536870912}]},{name:"ServiceOptions",field:[{name:"features",number:34,type:11,label:1,typeName:".google.protobuf.FeatureSet"},{name:"deprecated",number:33,type:8,label:1,defaultValue:"false"},{name:"uninterpreted_option",number:999,type:11,label:3,typeName:".google.protobuf.UninterpretedOption"}],extensionRange:[{start:990,end:999},{start:1e3,end:536870912}]},{name:"MethodOptions",field:[{name:"deprecated",number:33,type:8,label:1,defaultValue:"false"},{name:"idempotency_level",number:34,type:14,label:1,typeName:".google.protobuf.MethodOptions.IdempotencyLevel",defaultValue:"IDEMPOTENCY_UNKNOWN"},{name:"features",number:35,type:11,label:1,typeName:".google.protobuf.FeatureSet"},{name:"uninterpreted_option",number:999,type:11,label:3,typeName:".google.protobuf.UninterpretedOption"}],enumType:[{name:"IdempotencyLevel",value:[{name:"IDEMPOTENCY_UNKNOWN",number:0},{name:"NO_SIDE_EFFECTS",number:1},{name:"IDEMPOTENT",number:2}]}],extensionRange:[{start:990,end:999},{start:1e3,end:536870912}]},{name:"UninterpretedOption",field:[{name:"name",number:2,type:11,label:3,typeName:".google.protobuf.UninterpretedOption.NamePart"},{name:"identifier_value",number:3,type:9,label:1},{name:"positive_int_value",number:4,type:4,label:1},{name:"negative_int_value",number:5,type:3,label:1},{name:"double_value",number:6,type:1,label:1},{name:"string_value",number:7,type:12,label:1},{name:"aggregate_value",number:8,type:9,label:1}],nestedType:[{name:"NamePart",field:[{name:"name_part",number:1,type:9,label:2},{name:"is_extension",number:2,type:8,label:2}]}]},{name:"FeatureSet",field:[{name:"field_presence",number:1,type:14,label:1,typeName:".google.protobuf.FeatureSet.FieldPresence",options:{retention:1,targets:[4,1],editionDefaults:[{value:"EXPLICIT",edition:900},{value:"IMPLICIT",edition:999},{value:"EXPLICIT",edition:1e3}]}},{name:"enum_type",number:2,type:14,label:1,typeName:".google.protobuf.FeatureSet.EnumType",options:{retention:1,targets:[6,1],editionDefaults:[{value:"CLOSED",edition:900},{value:"OPEN",edition:999}]}},{name:"repeated_field_encoding",number:3,type:14,label:1,typeName:".google.protobuf.FeatureSet.RepeatedFieldEncoding",options:{retention:1,targets:[4,1],editionDefaults:[{value:"EXPANDED",edition:900},{value:"PACKED",edition:999}]}},{name:"utf8_validation",number:4,type:14,label:1,typeName:".google.protobuf.FeatureSet.Utf8Validation",options:{retention:1,targets:[4,1],editionDefaults:[{value:"NONE",edition:900},{value:"VERIFY",edition:999}]}},{name:"message_encoding",number:5,type:14,label:1,typeName:".google.protobuf.FeatureSet.MessageEncoding",options:{retention:1,targets:[4,1],editionDefaults:[{value:"LENGTH_PREFIXED",edition:900}]}},{name:"json_format",number:6,type:14,label:1,typeName:".google.protobuf.FeatureSet.JsonFormat",options:{retention:1,targets:[3,6,1],editionDefaults:[{value:"LEGACY_BEST_EFFORT",edition:900},{value:"ALLOW",edition:999}]}},{name:"enforce_naming_style",number:7,type:14,label:1,typeName:".google.protobuf.FeatureSet.EnforceNamingStyle",options:{retention:2,targets:[1,2,3,4,5,6,7,8,9],editionDefaults:[{value:"STYLE_LEGACY",edition:900},{value:"STYLE2024",edition:1001},{value:"STYLE2026",edition:1002}]}},{name:"default_symbol_visibility",number:8,type:14,label:1,typeName:".google.protobuf.FeatureSet.VisibilityFeature.DefaultSymbolVisibility",options:{retention:2,targets:[1],editionDefaults:[{value:"EXPORT_ALL",edition:900},{value:"EXPORT_TOP_LEVEL",edition:1001},{value:"STRICT",edition:1002}]}},{name:"enforce_proto_limits",number:9,type:14,label:1,typeName:".google.protobuf.FeatureSet.ProtoLimitsFeature.EnforceProtoLimits",options:{retention:2,targets:[6,3,4,5],editionDefaults:[{value:"LEGACY_NO_EXPLICIT_LIMITS",edition:900},{value:"PROTO_LIMITS2026",edition:1002}]}}],nestedType:[{name:"VisibilityFeature",enumType:[{name:"DefaultSymbolVisibility",value:[{name:"DEFAULT_SYMBOL_VISIBILITY_UNKNOWN",number:0},{name:"EXPORT_ALL",number:1},{name:"EXPORT_TOP_LEVEL",number:2},{name:"LOCAL_ALL",number:3},{name:"STRICT",number:4}]}]},{name:"ProtoLimitsFeature",enumType:[{name:"EnforceProtoLimits",value:[{name:"PROTO_LIMITS_UNKNOWN",number:0},{name:"LEGACY_NO_EXPLICIT_LIMITS",number:1},{name:"PROTO_LIMITS2026",number:2}]}]}],enumType:[{name:"FieldPresence",value:[{name:"FIELD_PRESENCE_UNKNOWN",number:0},{name:"EXPLICIT",number:1},{name:"IMPLICIT",number:2},{name:"LEGACY_REQUIRED",number:3}]},{name:"EnumType",value:[{name:"ENUM_TYPE_UNKNOWN",number:0},{name:"OPEN",number:1},{name:"CLOSED",number:2}]},{name:"RepeatedFieldEncoding",value:[{name:"REPEATED_FIELD_ENCODING_UNKNOWN",number:0},{name:"PACKED",number:1},{name:"EXPANDED",number:2}]},{name:"Utf8Validation",value:[{name:"UTF8_VALIDATION_UNKNOWN",number:0},{name:"VERIFY",number:2},{name:"NONE",number:3}]},{name:"MessageEncoding",value:[{name:"MESSAGE_ENCODING_UNKNOWN",number:0},{name:"LENGTH_PREFIXED",number:1},{name:"DELIMITED",number:2}]},{name:"JsonFormat",value:[{name:"JSON_FORMAT_UNKNOWN",number:0},{name:"ALLOW",number:1},{name:"LEGACY_BEST_EFFORT",number:2}]},{name:"EnforceNamingStyle",value:[{name:"ENFORCE_NAMING_STYLE_UNKNOWN",number:0},{name:"STYLE2024",number:1},{name:"STYLE_LEGACY",number:2},{name:"STYLE2026",number:3}]}],extensionRange:[{start:1e3,end:9995},{start:9995,end:1e4},{start:1e4,end:10001}]},{name:"FeatureSetDefaults",field:[{name:"defaults",number:1,type:11,label:3,typeName:".google.protobuf.FeatureSetDefaults.FeatureSetEditionDefault"},{name:"minimum_edition",number:4,type:14,label:1,typeName:".google.protobuf.Edition"},{name:"maximum_edition",number:5,type:14,label:1,typeName:".google.protobuf.Edition"}],nestedType:[{name:"FeatureSetEditionDefault",field:[{name:"edition",number:3,type:14,label:1,typeName:".google.protobuf.Edition"},{name:"overridable_features",number:4,type:11,label:1,typeName:".google.protobuf.FeatureSet"},{name:"fixed_features",number:5,type:11,label:1,typeName:".google.protobuf.FeatureSet"}]}]},{name:"SourceCodeInfo",field:[{name:"location",number:1,type:11,label:3,typeName:".google.protobuf.SourceCodeInfo.Location"}],nestedType:[{name:"Location",field:[{name:"path",number:1,type:5,label:3,options:{packed:!0}},{name:"span",number:2,type:5,label:3,options:{packed:!0}},{name:"leading_comments",number:3,type:9,label:1},{name:"trailing_comments",number:4,type:9,label:1},{name:"leading_detached_comments",number:6,type:9,label:3}]}],extensionRange:[{start:536e6,end:536000001}]},{name:"GeneratedCodeInfo",field:[{name:"annotation",number:1,type:11,label:3,typeName:".google.protobuf.GeneratedCodeInfo.Annotation"}],nestedType:[{name:"Annotation",field:[{name:"path",number:1,type:5,label:3,options:{packed:!0}},{name:"source_file",number:2,type:9,label:1},{name:"begin",number:3,type:5,label:1},{name:"end",number:4,type:5,label:1},{name:"semantic",number:5,type:14,label:1,typeName:".google.protobuf.GeneratedCodeInfo.Annotation.Semantic"}],enumType:[{name:"Semantic",value:[{name:"NONE",number:0},{name:"SET",number:1},{name:"ALIAS",number:2}]}]}]}],enumType:[{name:"Edition",value:[{name:"EDITION_UNKNOWN",number:0},{name:"EDITION_LEGACY",number:900},{name:"EDITION_PROTO2",number:998},{name:"EDITION_PROTO3",number:999},{name:"EDITION_2023",number:1e3},{name:"EDITION_2024",number:1001},{name:"EDITION_2026",number:1002},{name:"EDITION_UNSTABLE",number:9999},{name:"EDITION_1_TEST_ONLY",number:1},{name:"EDITION_2_TEST_ONLY",number:2},{name:"EDITION_99997_TEST_ONLY",number:99997},{name:"EDITION_99998_TEST_ONLY",number:99998},{name:"EDITION_99999_TEST_ONLY",number:99999},{name:"EDITION_MAX",number:2147483647}]},{name:"SymbolVisibility",value:[{name:"VISIBILITY_UNSET",number:0},{name:"VISIBILITY_LOCAL",number:1},{name:"VISIBILITY_EXPORT",number:2}]}]});var bm=rt(gs,1);var qf;(function(n){n[n.DECLARATION=0]="DECLARATION",n[n.UNVERIFIED=1]="UNVERIFIED"})(qf||(qf={}));var jf;(function(n){n[n.DOUBLE=1]="DOUBLE",n[n.FLOAT=2]="FLOAT",n[n.INT64=3]="INT64",n[n.UINT64=4]="UINT64",n[n.INT32=5]="INT32",n[n.FIXED64=6]="FIXED64",n[n.FIXED32=7]="FIXED32",n[n.BOOL=8]="BOOL",n[n.STRING=9]="STRING",n[n.GROUP=10]="GROUP",n[n.MESSAGE=11]="MESSAGE",n[n.BYTES=12]="BYTES",n[n.UINT32=13]="UINT32",n[n.ENUM=14]="ENUM",n[n.SFIXED32=15]="SFIXED32",n[n.SFIXED64=16]="SFIXED64",n[n.SINT32=17]="SINT32",n[n.SINT64=18]="SINT64"})(jf||(jf={}));var $f;(function(n){n[n.OPTIONAL=1]="OPTIONAL",n[n.REPEATED=3]="REPEATED",n[n.REQUIRED=2]="REQUIRED"})($f||($f={}));var em;(function(n){n[n.SPEED=1]="SPEED",n[n.CODE_SIZE=2]="CODE_SIZE",n[n.LITE_RUNTIME=3]="LITE_RUNTIME"})(em||(em={}));var tm;(function(n){n[n.STRING=0]="STRING",n[n.CORD=1]="CORD",n[n.STRING_PIECE=2]="STRING_PIECE"})(tm||(tm={}));var nm;(function(n){n[n.JS_NORMAL=0]="JS_NORMAL",n[n.JS_STRING=1]="JS_STRING",n[n.JS_NUMBER=2]="JS_NUMBER"})(nm||(nm={}));var im;(function(n){n[n.RETENTION_UNKNOWN=0]="RETENTION_UNKNOWN",n[n.RETENTION_RUNTIME=1]="RETENTION_RUNTIME",n[n.RETENTION_SOURCE=2]="RETENTION_SOURCE"})(im||(im={}));var sm;(function(n){n[n.TARGET_TYPE_UNKNOWN=0]="TARGET_TYPE_UNKNOWN",n[n.TARGET_TYPE_FILE=1]="TARGET_TYPE_FILE",n[n.TARGET_TYPE_EXTENSION_RANGE=2]="TARGET_TYPE_EXTENSION_RANGE",n[n.TARGET_TYPE_MESSAGE=3]="TARGET_TYPE_MESSAGE",n[n.TARGET_TYPE_FIELD=4]="TARGET_TYPE_FIELD",n[n.TARGET_TYPE_ONEOF=5]="TARGET_TYPE_ONEOF",n[n.TARGET_TYPE_ENUM=6]="TARGET_TYPE_ENUM",n[n.TARGET_TYPE_ENUM_ENTRY=7]="TARGET_TYPE_ENUM_ENTRY",n[n.TARGET_TYPE_SERVICE=8]="TARGET_TYPE_SERVICE",n[n.TARGET_TYPE_METHOD=9]="TARGET_TYPE_METHOD"})(sm||(sm={}));var rm;(function(n){n[n.IDEMPOTENCY_UNKNOWN=0]="IDEMPOTENCY_UNKNOWN",n[n.NO_SIDE_EFFECTS=1]="NO_SIDE_EFFECTS",n[n.IDEMPOTENT=2]="IDEMPOTENT"})(rm||(rm={}));var om;(function(n){n[n.DEFAULT_SYMBOL_VISIBILITY_UNKNOWN=0]="DEFAULT_SYMBOL_VISIBILITY_UNKNOWN",n[n.EXPORT_ALL=1]="EXPORT_ALL",n[n.EXPORT_TOP_LEVEL=2]="EXPORT_TOP_LEVEL",n[n.LOCAL_ALL=3]="LOCAL_ALL",n[n.STRICT=4]="STRICT"})(om||(om={}));var am;(function(n){n[n.PROTO_LIMITS_UNKNOWN=0]="PROTO_LIMITS_UNKNOWN",n[n.LEGACY_NO_EXPLICIT_LIMITS=1]="LEGACY_NO_EXPLICIT_LIMITS",n[n.PROTO_LIMITS2026=2]="PROTO_LIMITS2026"})(am||(am={}));var lm;(function(n){n[n.FIELD_PRESENCE_UNKNOWN=0]="FIELD_PRESENCE_UNKNOWN",n[n.EXPLICIT=1]="EXPLICIT",n[n.IMPLICIT=2]="IMPLICIT",n[n.LEGACY_REQUIRED=3]="LEGACY_REQUIRED"})(lm||(lm={}));var cm;(function(n){n[n.ENUM_TYPE_UNKNOWN=0]="ENUM_TYPE_UNKNOWN",n[n.OPEN=1]="OPEN",n[n.CLOSED=2]="CLOSED"})(cm||(cm={}));var um;(function(n){n[n.REPEATED_FIELD_ENCODING_UNKNOWN=0]="REPEATED_FIELD_ENCODING_UNKNOWN",n[n.PACKED=1]="PACKED",n[n.EXPANDED=2]="EXPANDED"})(um||(um={}));var dm;(function(n){n[n.UTF8_VALIDATION_UNKNOWN=0]="UTF8_VALIDATION_UNKNOWN",n[n.VERIFY=2]="VERIFY",n[n.NONE=3]="NONE"})(dm||(dm={}));var hm;(function(n){n[n.MESSAGE_ENCODING_UNKNOWN=0]="MESSAGE_ENCODING_UNKNOWN",n[n.LENGTH_PREFIXED=1]="LENGTH_PREFIXED",n[n.DELIMITED=2]="DELIMITED"})(hm||(hm={}));var pm;(function(n){n[n.JSON_FORMAT_UNKNOWN=0]="JSON_FORMAT_UNKNOWN",n[n.ALLOW=1]="ALLOW",n[n.LEGACY_BEST_EFFORT=2]="LEGACY_BEST_EFFORT"})(pm||(pm={}));var fm;(function(n){n[n.ENFORCE_NAMING_STYLE_UNKNOWN=0]="ENFORCE_NAMING_STYLE_UNKNOWN",n[n.STYLE2024=1]="STYLE2024",n[n.STYLE_LEGACY=2]="STYLE_LEGACY",n[n.STYLE2026=3]="STYLE2026"})(fm||(fm={}));var mm;(function(n){n[n.NONE=0]="NONE",n[n.SET=1]="SET",n[n.ALIAS=2]="ALIAS"})(mm||(mm={}));var gm;(function(n){n[n.EDITION_UNKNOWN=0]="EDITION_UNKNOWN",n[n.EDITION_LEGACY=900]="EDITION_LEGACY",n[n.EDITION_PROTO2=998]="EDITION_PROTO2",n[n.EDITION_PROTO3=999]="EDITION_PROTO3",n[n.EDITION_2023=1e3]="EDITION_2023",n[n.EDITION_2024=1001]="EDITION_2024",n[n.EDITION_2026=1002]="EDITION_2026",n[n.EDITION_UNSTABLE=9999]="EDITION_UNSTABLE",n[n.EDITION_1_TEST_ONLY=1]="EDITION_1_TEST_ONLY",n[n.EDITION_2_TEST_ONLY=2]="EDITION_2_TEST_ONLY",n[n.EDITION_99997_TEST_ONLY=99997]="EDITION_99997_TEST_ONLY",n[n.EDITION_99998_TEST_ONLY=99998]="EDITION_99998_TEST_ONLY",n[n.EDITION_99999_TEST_ONLY=99999]="EDITION_99999_TEST_ONLY",n[n.EDITION_MAX=2147483647]="EDITION_MAX"})(gm||(gm={}));var ym;(function(n){n[n.VISIBILITY_UNSET=0]="VISIBILITY_UNSET",n[n.VISIBILITY_LOCAL=1]="VISIBILITY_LOCAL",n[n.VISIBILITY_EXPORT=2]="VISIBILITY_EXPORT"})(ym||(ym={}));function Ie(n,e){var t;let i=jn(bm,Gs(n));return i.messageType.forEach(Qr),i.dependency=(t=e?.map(r=>r.proto.name))!==null&&t!==void 0?t:[],Na(i,r=>e?.find(o=>o.proto.name===r)).getFile(i.name)}var rn=Ie("Ch9nb29nbGUvcHJvdG9idWYvdGltZXN0YW1wLnByb3RvEg9nb29nbGUucHJvdG9idWYiKwoJVGltZXN0YW1wEg8KB3NlY29uZHMYASABKAMSDQoFbmFub3MYAiABKAVChQEKE2NvbS5nb29nbGUucHJvdG9idWZCDlRpbWVzdGFtcFByb3RvUAFaMmdvb2dsZS5nb2xhbmcub3JnL3Byb3RvYnVmL3R5cGVzL2tub3duL3RpbWVzdGFtcHBi+AEBogIDR1BCqgIeR29vZ2xlLlByb3RvYnVmLldlbGxLbm93blR5cGVzYgZwcm90bzM");var La=Ie("Ch5nb29nbGUvcHJvdG9idWYvZHVyYXRpb24ucHJvdG8SD2dvb2dsZS5wcm90b2J1ZiIqCghEdXJhdGlvbhIPCgdzZWNvbmRzGAEgASgDEg0KBW5hbm9zGAIgASgFQoMBChNjb20uZ29vZ2xlLnByb3RvYnVmQg1EdXJhdGlvblByb3RvUAFaMWdvb2dsZS5nb2xhbmcub3JnL3Byb3RvYnVmL3R5cGVzL2tub3duL2R1cmF0aW9ucGL4AQGiAgNHUEKqAh5Hb29nbGUuUHJvdG9idWYuV2VsbEtub3duVHlwZXNiBnByb3RvMw");var jr=Ie("Chlnb29nbGUvcHJvdG9idWYvYW55LnByb3RvEg9nb29nbGUucHJvdG9idWYiJgoDQW55EhAKCHR5cGVfdXJsGAEgASgJEg0KBXZhbHVlGAIgASgMQnYKE2NvbS5nb29nbGUucHJvdG9idWZCCEFueVByb3RvUAFaLGdvb2dsZS5nb2xhbmcub3JnL3Byb3RvYnVmL3R5cGVzL2tub3duL2FueXBiogIDR1BCqgIeR29vZ2xlLlByb3RvYnVmLldlbGxLbm93blR5cGVzYgZwcm90bzM"),xm=rt(jr,0);function vm(n,e,t){let i=!1;return t||(t=vt(xm),i=!0),t.value=Vs(n,e),t.typeUrl=Lv(e.$typeName),i?t:void 0}function Bv(n,e){if(n.typeUrl==="")return!1;let t=typeof e=="string"?e:e.typeName,i=_m(n.typeUrl);return t===i}function Sm(n,e){if(n.typeUrl==="")return;let t=e.kind=="message"?e:e.getMessage(_m(n.typeUrl));if(!(!t||!Bv(n,t)))return jn(t,n.value)}function Lv(n){return`type.googleapis.com/${n}`}function _m(n){let e=n.lastIndexOf("/"),t=e>=0?n.substring(e+1):n;if(!t.length)throw new Error(`invalid type url: ${n}`);return t}var hi=Ie("CiBnb29nbGUvcHJvdG9idWYvZmllbGRfbWFzay5wcm90bxIPZ29vZ2xlLnByb3RvYnVmIhoKCUZpZWxkTWFzaxINCgVwYXRocxgBIAMoCUKFAQoTY29tLmdvb2dsZS5wcm90b2J1ZkIORmllbGRNYXNrUHJvdG9QAVoyZ29vZ2xlLmdvbGFuZy5vcmcvcHJvdG9idWYvdHlwZXMva25vd24vZmllbGRtYXNrcGL4AQGiAgNHUEKqAh5Hb29nbGUuUHJvdG9idWYuV2VsbEtub3duVHlwZXNiBnByb3RvMw");var qu=Ie("Chxnb29nbGUvcHJvdG9idWYvc3RydWN0LnByb3RvEg9nb29nbGUucHJvdG9idWYihAEKBlN0cnVjdBIzCgZmaWVsZHMYASADKAsyIy5nb29nbGUucHJvdG9idWYuU3RydWN0LkZpZWxkc0VudHJ5GkUKC0ZpZWxkc0VudHJ5EgsKA2tleRgBIAEoCRIlCgV2YWx1ZRgCIAEoCzIWLmdvb2dsZS5wcm90b2J1Zi5WYWx1ZToCOAEi6gEKBVZhbHVlEjAKCm51bGxfdmFsdWUYASABKA4yGi5nb29nbGUucHJvdG9idWYuTnVsbFZhbHVlSAASFgoMbnVtYmVyX3ZhbHVlGAIgASgBSAASFgoMc3RyaW5nX3ZhbHVlGAMgASgJSAASFAoKYm9vbF92YWx1ZRgEIAEoCEgAEi8KDHN0cnVjdF92YWx1ZRgFIAEoCzIXLmdvb2dsZS5wcm90b2J1Zi5TdHJ1Y3RIABIwCgpsaXN0X3ZhbHVlGAYgASgLMhouZ29vZ2xlLnByb3RvYnVmLkxpc3RWYWx1ZUgAQgYKBGtpbmQiMwoJTGlzdFZhbHVlEiYKBnZhbHVlcxgBIAMoCzIWLmdvb2dsZS5wcm90b2J1Zi5WYWx1ZSobCglOdWxsVmFsdWUSDgoKTlVMTF9WQUxVRRAAQn8KE2NvbS5nb29nbGUucHJvdG9idWZCC1N0cnVjdFByb3RvUAFaL2dvb2dsZS5nb2xhbmcub3JnL3Byb3RvYnVmL3R5cGVzL2tub3duL3N0cnVjdHBi+AEBogIDR1BCqgIeR29vZ2xlLlByb3RvYnVmLldlbGxLbm93blR5cGVzYgZwcm90bzM"),Em=rt(qu,0),ju=rt(qu,1),Am=rt(qu,2),Fa;(function(n){n[n.NULL_VALUE=0]="NULL_VALUE"})(Fa||(Fa={}));function Mm(n,e,t){wm(e,n);let i=Fv(n.$unknown,e),[s,r,o]=ks(e),a=Fu(t);for(let l of i)Cf(s,new Vn(l.data),r,l.wireType,a);return o()}function Rm(n,e,t){var i;wm(e,n);let s=((i=n.$unknown)!==null&&i!==void 0?i:[]).filter(c=>c.no!==e.number),[r,o]=ks(e,t),a=new Ps;Rf(a,{writeUnknownFields:!0},r,o);let l=new Vn(a.finish());for(;l.pos<l.len;){let[c,u]=l.tag(),h=l.skip(u,c);s.push({no:c,wireType:u,data:h})}n.$unknown=s}function Fv(n,e){if(n===void 0)return[];if(e.fieldKind==="enum"||e.fieldKind==="scalar"){for(let t=n.length-1;t>=0;--t)if(n[t].no==e.number)return[n[t]];return[]}return n.filter(t=>t.no===e.number)}function ks(n,e){let t=n.typeName,i=Object.assign(Object.assign({},n),{kind:"field",parent:n.extendee,localName:t}),s=Object.assign(Object.assign({},n.extendee),{fields:[i],members:[i],oneofs:[]}),r=vt(s,e!==void 0?{[t]:e}:void 0);return[Vf(s,r),i,()=>{let o=r[t];if(o===void 0){let a=n.message;return Tn(a)?sn(a.fields[0].scalar,a.fields[0].longAsString):vt(a)}return o}]}function wm(n,e){if(n.extendee.typeName!=e.$typeName)throw new Error(`extension ${n.typeName} can only be applied to message ${n.extendee.typeName}`)}var Ua=Date.parse("0001-01-01T00:00:00Z"),Pa=Date.parse("9999-12-31T23:59:59Z"),Da=-315576e6,Ga=315576e6;var Uv=3,Pv=2,Tm={alwaysEmitImplicit:!1,enumAsInteger:!1,useProtoFieldName:!1};function Dv(n){return n?Object.assign(Object.assign({},Tm),n):Tm}function Gv(n,e,t){return Va(n)(Dv(t),e)}function Im(n,e,t){var i;let s=Gv(n,e,t);return JSON.stringify(s,null,(i=t?.prettySpaces)!==null&&i!==void 0?i:0)}var $u=new WeakMap;function Va(n){let e=$u.get(n);return e===void 0&&(e=Vv(n)),e}function Vv(n){let e=n.typeName,t=kv(n);if(t!==void 0){let a=n.fields[0],l=(c,u)=>{if(u.$typeName!==e&&a!==void 0)throw new et(a,`cannot use ${a} with message ${u.$typeName}`,"ForeignFieldError");return t(c,u)};return $u.set(n,l),l}let i=n.fields.concat().sort((a,l)=>a.number-l.number),s=i[0],r=[],o=(a,l)=>{if(l.$typeName!==e&&s!==void 0)throw new et(s,`cannot use ${s} with message ${l.$typeName}`,"ForeignFieldError");let c={};for(let u=0;u<r.length;u++)r[u](a,l,c);return a.registry&&Yv(c,a,a.registry,l,n),c};$u.set(n,o);for(let a of i){let l=Wv(a);r.push(a.jsonName==="__proto__"||a.name==="__proto__"?Ov(l):l)}return o}function Ov(n){return(e,t,i)=>{let s=Object.create(null);n(e,t,s);for(let r of Object.keys(s))jt(i,r,s[r])}}function kv(n){if(n.typeName.startsWith("google.protobuf."))switch(n.typeName){case"google.protobuf.Any":return(e,t)=>Jv(t,e);case"google.protobuf.Timestamp":return(e,t)=>qv(t);case"google.protobuf.Duration":return(e,t)=>Qv(t);case"google.protobuf.FieldMask":return(e,t)=>Kv(t);case"google.protobuf.Struct":return(e,t)=>Fm(t);case"google.protobuf.Value":return(e,t)=>nd(t);case"google.protobuf.ListValue":return(e,t)=>Um(t);default:if(Tn(n)){let e=n.fields[0],t=e.localName,i=sn(e.scalar,!1),s=Oa(e);return(r,o)=>{let a=o[t];return s(r,a===void 0?i:a)}}return}}function Wv(n){switch(n.fieldKind){case"scalar":case"enum":case"message":return zv(n);case"list":case"map":{let e=n.fieldKind=="list"?Bm(n):Lm(n),t=n.name,i=n.jsonName,s=n.localName;return(r,o,a)=>{let l=e(r,o[s]);l!==void 0&&(a[r.useProtoFieldName?t:i]=l)}}}}function zv(n){let e=Nm(n),t=n.name,i=n.jsonName,s=n.localName;if(n.oneof){let r=n.oneof.localName;return(o,a,l)=>{let c=a[r];c.case===s&&(l[o.useProtoFieldName?t:i]=e(o,c.value))}}if(n.presence!=Pv){let r=n.presence==Uv?`cannot encode ${n} to JSON: required field not set`:void 0;return(o,a,l)=>{let c=a[s];if(c!==void 0&&Object.prototype.hasOwnProperty.call(a,s))l[o.useProtoFieldName?t:i]=e(o,c);else if(r!==void 0)throw new Error(r)}}if(n.fieldKind=="enum"){let r=n.enum.values[0].number;return(o,a,l)=>{let c=a[s];(c!==r||o.alwaysEmitImplicit)&&(l[o.useProtoFieldName?t:i]=e(o,c))}}switch(n.scalar){case N.BOOL:return(r,o,a)=>{let l=o[s];(l!==!1||r.alwaysEmitImplicit)&&(a[r.useProtoFieldName?t:i]=e(r,l))};case N.STRING:return(r,o,a)=>{let l=o[s];(l!==""||r.alwaysEmitImplicit)&&(a[r.useProtoFieldName?t:i]=e(r,l))};case N.BYTES:return(r,o,a)=>{let l=o[s];(!(l instanceof Uint8Array)||l.byteLength>0||r.alwaysEmitImplicit)&&(a[r.useProtoFieldName?t:i]=e(r,l))};case N.DOUBLE:case N.FLOAT:return(r,o,a)=>{let l=o[s];(!Object.is(l,0)||r.alwaysEmitImplicit)&&(a[r.useProtoFieldName?t:i]=e(r,l))};default:return(r,o,a)=>{let l=o[s];(l!=0||r.alwaysEmitImplicit)&&(a[r.useProtoFieldName?t:i]=e(r,l))}}}function Xv(n){switch(n.fieldKind){case"scalar":case"enum":case"message":return Nm(n);case"list":return Bm(n);case"map":return Lm(n)}}function Nm(n){switch(n.fieldKind){case"scalar":return Oa(n);case"enum":return td(n);case"message":return ed(n)}}function ed(n){let{toMessage:e}=_n(n),t=Va(n.message);return(i,s)=>t(i,e(s))}function Bm(n){let e=Zv(n);return(t,i)=>{let s=i;if(s.length==0&&!t.alwaysEmitImplicit)return;let r=[];for(let o=0;o<s.length;o++)r.push(e(t,s[o]));return r}}function Zv(n){switch(n.listKind){case"scalar":return Oa(n);case"enum":return td(n);case"message":return ed(n)}}function Lm(n){let e=Hv(n);return(t,i)=>{let s=i,r=Object.keys(s);if(r.length==0&&!t.alwaysEmitImplicit)return;let o={};for(let a=0;a<r.length;a++){let l=r[a];jt(o,l,e(t,s[l]))}return o}}function Hv(n){switch(n.mapKind){case"scalar":return Oa(n);case"enum":return td(n);case"message":return ed(n)}}function td(n){let e=n.enum;return e.typeName=="google.protobuf.NullValue"?(t,i)=>{if(typeof i!="number")throw Cm(e,i);return null}:(t,i)=>{var s,r;if(typeof i!="number")throw Cm(e,i);return t.enumAsInteger?i:(r=(s=e.value[i])===null||s===void 0?void 0:s.jsonName)!==null&&r!==void 0?r:i}}function Cm(n,e){return new Error(`cannot encode ${n} to JSON: expected number, got ${Ct(e)}`)}function Oa(n){switch(n.scalar){case N.INT32:case N.SFIXED32:case N.SINT32:case N.FIXED32:case N.UINT32:return(e,t)=>{if(typeof t!="number")throw Ws(n,t);return t};case N.FLOAT:case N.DOUBLE:return(e,t)=>{if(typeof t!="number")throw Ws(n,t);return Number.isNaN(t)?"NaN":t===Number.POSITIVE_INFINITY?"Infinity":t===Number.NEGATIVE_INFINITY?"-Infinity":t};case N.STRING:return(e,t)=>{if(typeof t!="string")throw Ws(n,t);return t};case N.BOOL:return(e,t)=>{if(typeof t!="boolean")throw Ws(n,t);return t};case N.UINT64:case N.FIXED64:case N.INT64:case N.SFIXED64:case N.SINT64:return(e,t)=>{if(typeof t=="bigint"||typeof t=="string"||typeof t=="number"&&Number.isInteger(t))return t.toString();throw Ws(n,t)};case N.BYTES:return(e,t)=>{if(t instanceof Uint8Array)return Nu(t);throw Ws(n,t)}}}function Ws(n,e){var t;return new Error(`cannot encode ${n} to JSON: ${(t=Ra(n,e))===null||t===void 0?void 0:t.message}`)}function Yv(n,e,t,i,s){let r=i.$unknown;if(r===void 0)return;let o=new Set;for(let a=0;a<r.length;a++){let{no:l}=r[a];if(!o.has(l)){o.add(l);let c=t.getExtensionFor(s,l);if(!c)continue;let u=Mm(i,c),[h,p]=ks(c,u),d=h[Vt],f=Xv(p)(e,d[p.localName]);f!==void 0&&(n[c.jsonName]=f)}}}function Jv(n,e){if(n.typeUrl==="")return{};let{registry:t}=e,i,s;if(t&&(i=Sm(n,t),i&&(s=t.getMessage(i.$typeName))),!s||!i)throw new Error(`cannot encode message ${n.$typeName} to JSON: "${n.typeUrl}" is not in the type registry`);let r=xa(s)?{value:Va(s)(e,i)}:Va(s)(e,i);return r["@type"]=n.typeUrl,r}function Qv(n){let e=Number(n.seconds),t=n.nanos;if(e>Ga||e<Da)throw new Error(`cannot encode message ${n.$typeName} to JSON: value out of range`);if(e>0&&t<0||e<0&&t>0)throw new Error(`cannot encode message ${n.$typeName} to JSON: nanos sign must match seconds sign`);let i=n.seconds.toString();if(t!==0){let s=Math.abs(t).toString();s="0".repeat(9-s.length)+s,s.substring(3)==="000000"?s=s.substring(0,3):s.substring(6)==="000"&&(s=s.substring(0,6)),i+="."+s,t<0&&e==0&&(i="-"+i)}return i+"s"}function Kv(n){return n.paths.map(e=>{if(Ca(Mi(e))!==e)throw new Error(`cannot encode message ${n.$typeName} to JSON: lowerCamelCase of path name "${e}" is irreversible`);return Mi(e)}).join(",")}function Fm(n){let e={},t=Object.keys(n.fields);for(let i=0;i<t.length;i++){let s=t[i];jt(e,s,nd(n.fields[s]))}return e}function nd(n){switch(n.kind.case){case"nullValue":return null;case"numberValue":if(!Number.isFinite(n.kind.value))throw new Error(`${n.$typeName} cannot be NaN or Infinity`);return n.kind.value;case"boolValue":return n.kind.value;case"stringValue":return n.kind.value;case"structValue":return Fm(n.kind.value);case"listValue":return Um(n.kind.value);default:throw new Error(`${n.$typeName} must have a value`)}}function Um(n){return n.values.map(nd)}function qv(n){let e=Number(n.seconds)*1e3;if(e<Ua||e>Pa)throw new Error(`cannot encode message ${n.$typeName} to JSON: must be from 0001-01-01T00:00:00Z to 9999-12-31T23:59:59Z inclusive`);if(n.nanos<0)throw new Error(`cannot encode message ${n.$typeName} to JSON: nanos must not be negative`);if(n.nanos>999999999)throw new Error(`cannot encode message ${n.$typeName} to JSON: nanos must not be greater than 999999999`);let t="Z";if(n.nanos>0){let i=(n.nanos+1e9).toString().substring(1);i.substring(3)==="000000"?t="."+i.substring(0,3)+"Z":i.substring(6)==="000"?t="."+i.substring(0,6)+"Z":t="."+i+"Z"}return new Date(e).toISOString().replace(".000Z",t)}var jv=2;function $v(n){return Object.assign(Object.assign({ignoreUnknownFields:!1,recursionLimit:100},n),{depth:0})}function Dm(n,e,t){return eS(n,dS(e,n.typeName),t)}function eS(n,e,t){let i=vt(n);return tS(n,i,e,t),i}function tS(n,e,t,i){try{zs(n)(e,t,$v(i))}catch(s){throw sf(s)?new Error(`cannot decode ${s.field()} from JSON: ${s.message}`,{cause:s}):s}}var id=new WeakMap;function zs(n){let e=id.get(n);return e===void 0&&(e=nS(n)),e}function nS(n){let e=String(n),t=iS(n);if(t!==void 0){let o=(a,l,c)=>{if(++c.depth>c.recursionLimit)throw new Error(`cannot decode ${e} from JSON: maximum recursion depth of ${c.recursionLimit} reached`);t(a,l,c),c.depth--};return id.set(n,o),o}let i=n.typeName,s=new Map,r=(o,a,l)=>{var c;if(++l.depth>l.recursionLimit)throw new Error(`cannot decode ${e} from JSON: maximum recursion depth of ${l.recursionLimit} reached`);if(a==null||Array.isArray(a)||typeof a!="object")throw new Error(`cannot decode ${e} from JSON: ${Ct(a)}`);let u=new Map,h=new Set,p=Object.keys(a);for(let d=0;d<p.length;d++){let f=p[d],b=a[f],g=s.get(f);if(g!==void 0){let m=g.field;if(h.has(m))throw new et(m,"set multiple times");if(h.add(m),g.oneofScalarNullSkip&&b===null)continue;if(g.oneof){let S=u.get(g.oneof);if(S!==void 0)throw new et(g.oneof,`oneof set multiple times by ${S.name} and ${m.name}`);u.set(g.oneof,m)}g.read(o,b,l)}else{let m=f.startsWith("[")&&f.endsWith("]")?(c=l.registry)===null||c===void 0?void 0:c.getExtension(f.substring(1,f.length-1)):void 0;if(m?.extendee.typeName==i){let[S,A,_]=ks(m);Pm(A)(S[Vt],b,l),Rm(o,m,_())}if(m===void 0&&!l.ignoreUnknownFields)throw new Error(`cannot decode ${e} from JSON: key "${f}" is unknown`)}}l.depth--};id.set(n,r);for(let o of n.fields){let a={read:Pm(o),field:o,oneof:o.oneof,oneofScalarNullSkip:o.oneof!==void 0&&o.fieldKind=="scalar"};s.set(o.name,a).set(o.jsonName,a)}return r}function iS(n){if(n.typeName.startsWith("google.protobuf."))switch(n.typeName){case"google.protobuf.Any":return(e,t,i)=>pS(e,t,i);case"google.protobuf.Timestamp":return(e,t)=>fS(e,t);case"google.protobuf.Duration":return(e,t)=>mS(e,t);case"google.protobuf.FieldMask":return(e,t)=>gS(e,t);case"google.protobuf.Struct":return(e,t,i)=>km(e,t,i);case"google.protobuf.Value":return(e,t,i)=>ld(e,t,i);case"google.protobuf.ListValue":return(e,t,i)=>Wm(e,t,i);default:if(Tn(n)){let e=n.fields[0],t=e.localName,i=e.scalar,s=e.longAsString,r=Vm(e);return(o,a)=>{a===null?o[t]=sn(i,s):o[t]=r(a)}}return}}function Pm(n){switch(n.fieldKind){case"scalar":return sS(n);case"enum":return rS(n);case"message":return oS(n);case"list":return aS(n);case"map":return cS(n)}}function sS(n){let e=Vm(n),t=n.localName;if(n.oneof){let s=n.oneof.localName;return(r,o)=>{r[s]={case:t,value:e(o)}}}let i=Gm(n);return(s,r)=>{r===null?i(s):s[t]=e(r)}}function Gm(n){let e=n.localName;if(n.presence!=jv)return s=>{delete s[e]};if(n.fieldKind=="enum"){let s=n.enum.values[0].number;return r=>{r[e]=s}}let t=n.scalar,i=n.longAsString;return s=>{s[e]=sn(t,i)}}function rS(n){let e=sd(n.enum),t=rd(n.enum),i=n.localName,s=n.enum.typeName!="google.protobuf.NullValue";if(n.oneof){let o=n.oneof.localName;return(a,l,c)=>{if(l===null&&s){a[o].case===i&&(a[o]={case:void 0});return}let u=e(l,c.ignoreUnknownFields);if(u===Xs)return;let h=t(u);if(h!==!0)throw new et(n,On(n,u,h));a[o]={case:i,value:u}}}let r=Gm(n);return(o,a,l)=>{if(a===null&&s){r(o);return}let c=e(a,l.ignoreUnknownFields);if(c===Xs)return;let u=t(c);if(u!==!0)throw new et(n,On(n,c,u));o[i]=c}}function oS(n){let e=n.localName,{toMessage:t,toLocal:i}=_n(n),s=zs(n.message),r=n.message.typeName!="google.protobuf.Value";if(n.oneof){let o=n.oneof.localName;return(a,l,c)=>{let u=a[o];if(l===null&&r){u.case===e&&(a[o]={case:void 0});return}let h=t(u.case===e?u.value:void 0);s(h,l,c),a[o]={case:e,value:i(h)}}}return(o,a,l)=>{if(a===null&&r){delete o[e];return}let c=t(o[e]);s(c,a,l),o[e]=i(c)}}function aS(n){let e=n.localName,t=lS(n);return(i,s,r)=>{if(s===null)return;if(!Array.isArray(s))throw new et(n,"expected Array, got "+Ct(s));let o=i[e];for(let a=0;a<s.length;a++){let l=t(s[a],r,o.length);l!==Xs&&o.push(l)}}}function lS(n){switch(n.listKind){case"scalar":{let e=od(n),t=Ai(n.scalar),i=ad(n);return(s,r,o)=>{if(s===null)throw new et(n,"list item must not be null");let a=e(s),l=t(a);if(l!==!0)throw new et(n,`list item #${o+1}: ${On(n,a,l)}`);return i(a)}}case"enum":{let e=sd(n.enum),t=rd(n.enum),i=n.enum.typeName!="google.protobuf.NullValue";return(s,r,o)=>{if(s===null&&i)throw new et(n,"list item must not be null");let a=e(s,r.ignoreUnknownFields);if(a===Xs)return a;let l=t(a);if(l!==!0)throw new et(n,`list item #${o+1}: ${On(n,a,l)}`);return a}}case"message":{let{toMessage:e,toLocal:t}=_n(n),i=zs(n.message),s=n.message.typeName!="google.protobuf.Value";return(r,o)=>{if(r===null&&s)throw new et(n,"list item must not be null");let a=e(void 0);return i(a,r,o),t(a)}}}}function cS(n){let e=n.localName,t=n.mapKey,i=uS(t),s=Ai(t),r,o,a=c=>c,l=!0;switch(n.mapKind){case"scalar":{r=od(n),o=Ai(n.scalar),a=ad(n);break}case"enum":{let c=sd(n.enum);r=(u,h)=>c(u,h.ignoreUnknownFields),o=rd(n.enum),l=n.enum.typeName!="google.protobuf.NullValue";break}case"message":{let{toMessage:c,toLocal:u}=_n(n),h=zs(n.message);l=n.message.typeName!="google.protobuf.Value",r=(p,d)=>{let f=c(void 0);return h(f,p,d),u(f)};break}}return(c,u,h)=>{if(u===null)return;if(typeof u!="object"||Array.isArray(u))throw new et(n,"expected object, got "+Ct(u));let p=c[e],d=new Set,f=Object.keys(u);for(let b=0;b<f.length;b++){let g=f[b],m=u[g],S=i(g);if(d.has(S))throw new et(n,`duplicate map key "${g}"`);if(d.add(S),m===null&&l)throw new et(n,"map value must not be null");let A=r(m,h);if(A===Xs)continue;let _=s(S);if(_!==!0)throw new et(n,`invalid map key: ${On({scalar:t},S,_)}`);if(o!==void 0){let w=o(A);if(w!==!0)throw new et(n,`map entry ${Ct(S)}: ${On(n,A,w)}`)}jt(p,S,a(A))}}}var Xs=Symbol();function sd(n){let e=n.values[0].number,t=new Map;for(let i of n.values)t.set(i.jsonName,i.number);for(let i of n.values)t.set(i.name,i.number);return(i,s)=>{if(i===null)return e;switch(typeof i){case"number":if(Number.isInteger(i))return i;break;case"string":{let r=t.get(i);if(r!==void 0)return r;if(s)return Xs;break}}throw new Error(`cannot decode ${n} from JSON: ${Ct(i)}`)}}function rd(n){if(n.open)return Ai(N.INT32);let e=n.values;return t=>e.some(i=>i.number===t)}function Vm(n){let e=od(n),t=Ai(n.scalar),i=ad(n);return s=>{let r=e(s),o=t(r);if(o!==!0)throw new et(n,On(n,r,o));return i(r)}}function od(n){switch(n.scalar){case N.DOUBLE:case N.FLOAT:return e=>{if(e==="NaN")return NaN;if(e==="Infinity")return Number.POSITIVE_INFINITY;if(e==="-Infinity")return Number.NEGATIVE_INFINITY;if(typeof e=="number"){if(Number.isNaN(e))throw new et(n,"unexpected NaN number");if(!Number.isFinite(e))throw new et(n,"unexpected infinite number");return e}if(typeof e=="string"){if(e===""||e.trim().length!==e.length)return e;let t=Number(e);return Number.isFinite(t)?t:e}return e};case N.INT32:case N.FIXED32:case N.SFIXED32:case N.SINT32:case N.UINT32:return Om;case N.BYTES:return e=>{if(typeof e=="string"){if(e==="")return new Uint8Array(0);try{return Gs(e)}catch(t){let i=t instanceof Error?t.message:String(t);throw new et(n,i)}}return e};default:return e=>e}}function ad(n){let e=n.fieldKind!=="map"&&n.longAsString;switch(n.scalar){case N.INT64:case N.SFIXED64:case N.SINT64:return e?t=>String(t):t=>typeof t=="string"||typeof t=="number"?$e.parse(t):t;case N.FIXED64:case N.UINT64:return e?t=>String(t):t=>typeof t=="string"||typeof t=="number"?$e.uParse(t):t;default:return t=>t}}function uS(n){switch(n){case N.BOOL:return e=>{switch(e){case"true":return!0;case"false":return!1}return e};case N.INT32:case N.FIXED32:case N.UINT32:case N.SFIXED32:case N.SINT32:return Om;case N.INT64:case N.SINT64:case N.SFIXED64:case N.UINT64:case N.FIXED64:return e=>/^-?0+$/.test(e)?"0":e.replace(/^(-?)0+(?=\d)/,"$1");default:return e=>e}}function Om(n){if(typeof n=="string"){if(n===""||n.trim().length!==n.length)return n;let e=Number(n);return Number.isNaN(e)?n:e}return n}function dS(n,e){let t;try{t=JSON.parse(n)}catch(i){let s=i instanceof Error?i.message:String(i);throw new Error(`cannot decode message ${e} from JSON: ${s}`,{cause:i})}return hS(n,e),t}function hS(n,e){let t=[],i=!1,s=0;for(;s<n.length;)switch(n[s]){case"{":t.push(new Set),i=!0,s++;break;case"[":t.push(null),i=!1,s++;break;case"}":case"]":t.pop(),i=!1,s++;break;case",":i=t[t.length-1]!=null,s++;break;case":":i=!1,s++;break;case'"':{let r=s++,o=!1;for(;s<n.length;){if(n[s]=="\\"){o=!0,s+=2;continue}if(n[s]=='"')break;s++}let a=s++,l=t[t.length-1];if(i&&l){let c=o?JSON.parse(n.substring(r,a+1)):n.substring(r+1,a);if(l.has(c))throw new Error(`cannot decode message ${e} from JSON: duplicate object key "${c}"`);l.add(c)}i=!1;break}default:s++;break}}function pS(n,e,t){var i;if(e===null||Array.isArray(e)||typeof e!="object")throw new Error(`cannot decode message ${n.$typeName} from JSON: expected object but got ${Ct(e)}`);if(Object.keys(e).length==0)return;let s=e["@type"];if(typeof s!="string"||s=="")throw new Error(`cannot decode message ${n.$typeName} from JSON: "@type" is empty`);let r=s.includes("/")?s.substring(s.lastIndexOf("/")+1):s;if(!r.length)throw new Error(`cannot decode message ${n.$typeName} from JSON: "@type" is invalid`);let o=(i=t.registry)===null||i===void 0?void 0:i.getMessage(r);if(!o)throw new Error(`cannot decode message ${n.$typeName} from JSON: ${s} is not in the type registry`);let a=vt(o);if(xa(o)&&Object.prototype.hasOwnProperty.call(e,"value"))zs(o)(a,e.value,t);else{let l={};for(let c of Object.keys(e))c!=="@type"&&jt(l,c,e[c]);zs(o)(a,l,t)}vm(o,a,n)}function fS(n,e){if(typeof e!="string")throw new Error(`cannot decode message ${n.$typeName} from JSON: ${Ct(e)}`);let t=e.match(/^([0-9]{4})-([0-9]{2})-([0-9]{2})T([0-9]{2}):([0-9]{2}):([0-9]{2})(?:\.([0-9]{1,9}))?(?:Z|([+-][0-9][0-9]:[0-9][0-9]))$/);if(!t)throw new Error(`cannot decode message ${n.$typeName} from JSON: invalid RFC 3339 string`);let i=Date.parse(t[1]+"-"+t[2]+"-"+t[3]+"T"+t[4]+":"+t[5]+":"+t[6]+(t[8]?t[8]:"Z"));if(Number.isNaN(i))throw new Error(`cannot decode message ${n.$typeName} from JSON: invalid RFC 3339 string`);if(i<Ua||i>Pa)throw new Error(`cannot decode message ${n.$typeName} from JSON: must be from 0001-01-01T00:00:00Z to 9999-12-31T23:59:59Z inclusive`);n.seconds=$e.parse(i/1e3),n.nanos=0,t[7]&&(n.nanos=parseInt("1"+t[7]+"0".repeat(9-t[7].length))-1e9)}function mS(n,e){if(typeof e!="string")throw new Error(`cannot decode message ${n.$typeName} from JSON: ${Ct(e)}`);let t=e.match(/^(-?[0-9]+)(?:\.([0-9]+))?s/);if(t===null)throw new Error(`cannot decode message ${n.$typeName} from JSON: ${Ct(e)}`);let i=Number(t[1]);if(i>Ga||i<Da)throw new Error(`cannot decode message ${n.$typeName} from JSON: ${Ct(e)}`);if(n.seconds=$e.parse(i),typeof t[2]!="string")return;let s=t[2]+"0".repeat(9-t[2].length);n.nanos=parseInt(s),(i<0||Object.is(i,-0))&&(n.nanos=-n.nanos)}function gS(n,e){if(typeof e!="string")throw new Error(`cannot decode message ${n.$typeName} from JSON: ${Ct(e)}`);e!==""&&(n.paths=e.split(",").map(t=>{if(t.includes("_"))throw new Error(`cannot decode message ${n.$typeName} from JSON: path names must be lowerCamelCase`);return Ca(t)}))}function km(n,e,t){if(typeof e!="object"||e==null||Array.isArray(e))throw new Error(`cannot decode message ${n.$typeName} from JSON ${Ct(e)}`);let i=Object.keys(e);for(let s=0;s<i.length;s++){let r=i[s],o=vt(ju);ld(o,e[r],t),jt(n.fields,r,o)}}function ld(n,e,t){if(++t.depth>t.recursionLimit)throw new Error(`cannot decode ${n.$typeName} from JSON: maximum recursion depth of ${t.recursionLimit} reached`);switch(typeof e){case"number":n.kind={case:"numberValue",value:e};break;case"string":n.kind={case:"stringValue",value:e};break;case"boolean":n.kind={case:"boolValue",value:e};break;case"object":if(e===null)n.kind={case:"nullValue",value:Fa.NULL_VALUE};else if(Array.isArray(e)){let i=vt(Am);Wm(i,e,t),n.kind={case:"listValue",value:i}}else{let i=vt(Em);km(i,e,t),n.kind={case:"structValue",value:i}}break;default:throw new Error(`cannot decode message ${n.$typeName} from JSON ${Ct(e)}`)}return t.depth--,n}function Wm(n,e,t){if(!Array.isArray(e))throw new Error(`cannot decode message ${n.$typeName} from JSON ${Ct(e)}`);for(let i=0;i<e.length;i++){let s=vt(ju);ld(s,e[i],t),n.values.push(s)}}function cd(n){let e=Ae[n];return typeof e!="string"?n.toString():e[0].toLowerCase()+e.substring(1).replace(/[A-Z]/g,t=>"_"+t.toLowerCase())}var Ve=class n extends Error{constructor(e,t=Ae.Unknown,i,s,r){super(yS(e,t)),this.name="ConnectError",this.isWireError=!1,Object.setPrototypeOf(this,new.target.prototype),this.rawMessage=e,this.code=t,this.metadata=new Headers(i??{}),this.details=s??[],this.cause=r}static from(e,t=Ae.Unknown){return e instanceof n?e:e instanceof Error?e.name=="AbortError"||e.name=="TimeoutError"?new n(e.message,Ae.Canceled):new n(e.message,t,void 0,void 0,e):new n(String(e),t,void 0,void 0,e)}static[Symbol.hasInstance](e){return e instanceof Error?Object.getPrototypeOf(e)===n.prototype?!0:e.name==="ConnectError"&&"code"in e&&typeof e.code=="number"&&"metadata"in e&&"details"in e&&Array.isArray(e.details)&&"rawMessage"in e&&typeof e.rawMessage=="string"&&"cause"in e:!1}findDetails(e){let t=e.kind==="message"?{getMessage:s=>s===e.typeName?e:void 0}:e,i=[];for(let s of this.details){if("desc"in s){t.getMessage(s.desc.typeName)&&i.push(vt(s.desc,s.value));continue}let r=t.getMessage(s.type);if(r)try{i.push(jn(r,s.value))}catch{}}return i}};function yS(n,e){return n.length?`[${cd(e)}] ${n}`:`[${cd(e)}]`}function zm(n,e,t){try{let i=Gs(n);return e?jn(e,i,t):i}catch(i){throw Ve.from(i,Ae.DataLoss)}}function Xm(n,e){let t={};for(let i of n.methods){let s=e(i);s!=null&&(t[i.localName]=s)}return t}var ka=1;function Zm(n,e,t=!1){if(e>n){let i=`message size is larger than configured readMaxBytes ${n}`;throw t&&(i=`message size ${e} is larger than configured readMaxBytes ${n}`),new Ve(i,Ae.ResourceExhausted)}}function bS(n){return new ud(n)}var ud=class{constructor(e){this.readMaxBytes=e,this.header=new Uint8Array(5),this.headerView=new DataView(this.header.buffer),this.buf=[]}get byteLength(){return this.buf.reduce((e,t)=>e+t.byteLength,0)}decode(e){this.buf.push(e);let t=[];for(;;){let i=this.pop();if(!i)break;t.push(i)}return t}pop(){if(!(!this.env&&(this.env=this.head(),!this.env))&&this.cons(this.env.data)){let e=this.env;return this.env=void 0,e}}head(){if(!this.cons(this.header))return;let e=this.headerView.getUint8(0),t=this.headerView.getUint32(1);return Zm(this.readMaxBytes,t,!0),{flags:e,data:new Uint8Array(t)}}cons(e){let t=e.byteLength;if(this.byteLength<t)return!1;let i=0;for(;i<t;){let s=this.buf.shift();s.byteLength>t-i?(e.set(s.subarray(0,t-i),i),this.buf.unshift(s.subarray(t-i)),i+=t-i):(e.set(s,i),i+=s.byteLength)}return!0}};function Wa(n){let e,t=bS(4294967295);return new ReadableStream({start(){e=n.getReader()},async pull(i){let s=!1;for(;!s;){let r=await e.read();if(r.done)t.byteLength>0&&i.error(new Ve("protocol error: incomplete envelope",Ae.InvalidArgument)),i.close();else for(let o of t.decode(r.value))i.enqueue(o),s=!0}}})}function za(n,e){let t=new Uint8Array(e.length+5);t.set(e,5);let i=new DataView(t.buffer,t.byteOffset,t.byteLength);return i.setUint8(0,n),i.setUint32(1,e.length),t}var xS=function(n){if(!Symbol.asyncIterator)throw new TypeError("Symbol.asyncIterator is not defined.");var e=n[Symbol.asyncIterator],t;return e?e.call(n):(n=typeof __values=="function"?__values(n):n[Symbol.iterator](),t={},i("next"),i("throw"),i("return"),t[Symbol.asyncIterator]=function(){return this},t);function i(r){t[r]=n[r]&&function(o){return new Promise(function(a,l){o=n[r](o),s(a,l,o.done,o.value)})}}function s(r,o,a,l){Promise.resolve(l).then(function(c){r({value:c,done:a})},o)}},$r=function(n){return this instanceof $r?(this.v=n,this):new $r(n)},vS=function(n,e,t){if(!Symbol.asyncIterator)throw new TypeError("Symbol.asyncIterator is not defined.");var i=t.apply(n,e||[]),s,r=[];return s=Object.create((typeof AsyncIterator=="function"?AsyncIterator:Object).prototype),a("next"),a("throw"),a("return",o),s[Symbol.asyncIterator]=function(){return this},s;function o(d){return function(f){return Promise.resolve(f).then(d,h)}}function a(d,f){i[d]&&(s[d]=function(b){return new Promise(function(g,m){r.push([d,b,g,m])>1||l(d,b)})},f&&(s[d]=f(s[d])))}function l(d,f){try{c(i[d](f))}catch(b){p(r[0][3],b)}}function c(d){d.value instanceof $r?Promise.resolve(d.value.v).then(u,h):p(r[0][2],d)}function u(d){l("next",d)}function h(d){l("throw",d)}function p(d,f){d(f),r.shift(),r.length&&l(r[0][0],r[0][1])}},SS=function(n){var e,t;return e={},i("next"),i("throw",function(s){throw s}),i("return"),e[Symbol.iterator]=function(){return this},e;function i(s,r){e[s]=n[s]?function(o){return(t=!t)?{value:$r(n[s](o)),done:!1}:r?r(o):o}:r}};function Hm(n){return vS(this,arguments,function*(){yield $r(yield*SS(xS(n)))})}var Ym=function(n){if(!Symbol.asyncIterator)throw new TypeError("Symbol.asyncIterator is not defined.");var e=n[Symbol.asyncIterator],t;return e?e.call(n):(n=typeof __values=="function"?__values(n):n[Symbol.iterator](),t={},i("next"),i("throw"),i("return"),t[Symbol.asyncIterator]=function(){return this},t);function i(r){t[r]=n[r]&&function(o){return new Promise(function(a,l){o=n[r](o),s(a,l,o.done,o.value)})}}function s(r,o,a,l){Promise.resolve(l).then(function(c){r({value:c,done:a})},o)}},Zs=function(n){return this instanceof Zs?(this.v=n,this):new Zs(n)},_S=function(n){var e,t;return e={},i("next"),i("throw",function(s){throw s}),i("return"),e[Symbol.iterator]=function(){return this},e;function i(s,r){e[s]=n[s]?function(o){return(t=!t)?{value:Zs(n[s](o)),done:!1}:r?r(o):o}:r}},ES=function(n,e,t){if(!Symbol.asyncIterator)throw new TypeError("Symbol.asyncIterator is not defined.");var i=t.apply(n,e||[]),s,r=[];return s=Object.create((typeof AsyncIterator=="function"?AsyncIterator:Object).prototype),a("next"),a("throw"),a("return",o),s[Symbol.asyncIterator]=function(){return this},s;function o(d){return function(f){return Promise.resolve(f).then(d,h)}}function a(d,f){i[d]&&(s[d]=function(b){return new Promise(function(g,m){r.push([d,b,g,m])>1||l(d,b)})},f&&(s[d]=f(s[d])))}function l(d,f){try{c(i[d](f))}catch(b){p(r[0][3],b)}}function c(d){d.value instanceof Zs?Promise.resolve(d.value.v).then(u,h):p(r[0][2],d)}function u(d){l("next",d)}function h(d){l("throw",d)}function p(d,f){d(f),r.shift(),r.length&&l(r[0][0],r[0][1])}};function $t(n,e){return Xm(n,t=>{switch(t.methodKind){case"unary":return AS(e,t);case"server_streaming":return MS(e,t);case"client_streaming":return RS(e,t);case"bidi_streaming":return wS(e,t);default:return null}})}function AS(n,e){return async(t,i)=>{var s,r;let o=await n.unary(e,i?.signal,i?.timeoutMs,i?.headers,t,i?.contextValues);return(s=i?.onHeader)===null||s===void 0||s.call(i,o.header),(r=i?.onTrailer)===null||r===void 0||r.call(i,o.trailer),o.message}}function MS(n,e){return(t,i)=>Jm(n.stream(e,i?.signal,i?.timeoutMs,i?.headers,Hm([t]),i?.contextValues),i)}function RS(n,e){return async(t,i)=>{var s,r,o,a,l,c;let u=await n.stream(e,i?.signal,i?.timeoutMs,i?.headers,t,i?.contextValues);(l=i?.onHeader)===null||l===void 0||l.call(i,u.header);let h,p=0;try{for(var d=!0,f=Ym(u.message),b;b=await f.next(),s=b.done,!s;d=!0)a=b.value,d=!1,h=a,p++}catch(g){r={error:g}}finally{try{!d&&!s&&(o=f.return)&&await o.call(f)}finally{if(r)throw r.error}}if(!h)throw new Ve("protocol error: missing response message",Ae.Unimplemented);if(p>1)throw new Ve("protocol error: received extra messages for client streaming method",Ae.Unimplemented);return(c=i?.onTrailer)===null||c===void 0||c.call(i,u.trailer),h}}function wS(n,e){return(t,i)=>Jm(n.stream(e,i?.signal,i?.timeoutMs,i?.headers,t,i?.contextValues),i)}function Jm(n,e){let t=(function(){return ES(this,arguments,function*(){var i,s;let r=yield Zs(n);(i=e?.onHeader)===null||i===void 0||i.call(e,r.header),yield Zs(yield*_S(Ym(r.message))),(s=e?.onTrailer)===null||s===void 0||s.call(e,r.trailer)})})()[Symbol.asyncIterator]();return{[Symbol.asyncIterator]:()=>({next:()=>t.next()})}}function Qm(...n){let e=new AbortController,t=n.filter(s=>s!==void 0).concat(e.signal);for(let s of t){if(s.aborted){i.apply(s);break}s.addEventListener("abort",i)}function i(){e.signal.aborted||e.abort(Xa(this));for(let s of t)s.removeEventListener("abort",i)}return e}function Km(n){let e=new AbortController,t=()=>{e.abort(new Ve("the operation timed out",Ae.DeadlineExceeded))},i;return n!==void 0&&(n<=0?t():i=setTimeout(t,n)),{signal:e.signal,cleanup:()=>clearTimeout(i)}}function Xa(n){if(!n.aborted)return;if(n.reason!==void 0)return n.reason;let e=new Error("This operation was aborted");return e.name="AbortError",e}function Za(){return{get(n){return n.id in this?this[n.id]:n.defaultValue},set(n,e){return this[n.id]=e,this},delete(n){return delete this[n.id],this}}}function Ha(n){let e=new Headers,t=new TextDecoder().decode(n).split(`\r
`);for(let i of t){if(i==="")continue;let s=i.indexOf(":");if(s>0){let r=i.substring(0,s).trim(),o=i.substring(s+1).trim();e.append(r,o)}}return e}var dd="Content-Type";var hd="Grpc-Timeout",ei="Grpc-Status",eo="Grpc-Message";var pd="Grpc-Status-Details-Bin";var Ya="User-Agent";var fd="X-User-Agent",jm="X-Grpc-Web";var $m="application/grpc-web+proto",eg="application/grpc-web+json";function ot(n,e,...t){if(t.length>0)throw new Error;return n.services[e]}var CS=Ie("CgxzdGF0dXMucHJvdG8SCmdvb2dsZS5ycGMiTgoGU3RhdHVzEgwKBGNvZGUYASABKAUSDwoHbWVzc2FnZRgCIAEoCRIlCgdkZXRhaWxzGAMgAygLMhQuZ29vZ2xlLnByb3RvYnVmLkFueUJeCg5jb20uZ29vZ2xlLnJwY0ILU3RhdHVzUHJvdG9QAVo3Z29vZ2xlLmdvbGFuZy5vcmcvZ2VucHJvdG8vZ29vZ2xlYXBpcy9ycGMvc3RhdHVzO3N0YXR1c6ICA1JQQ2IGcHJvdG8z",[jr]),tg=rt(CS,0);var ng="0";function Ja(n){var e;let t=n.get(pd);if(t!=null){let s=zm(t,tg);if(s.code==0)return;let r=new Ve(s.message,s.code,n);return r.details=s.details.map(o=>({type:o.typeUrl.substring(o.typeUrl.lastIndexOf("/")+1),value:o.value})),r.isWireError=!0,r}let i=n.get(ei);if(i!=null){if(i===ng)return;let s=parseInt(i,10),r;return s in Ae?r=new Ve(decodeURIComponent((e=n.get(eo))!==null&&e!==void 0?e:""),s,n):r=new Ve(`invalid grpc-status: ${i}`,Ae.Internal,n),r.isWireError=!0,r}}function Qa(n,e){return n.toString().replace(/\/?$/,`/${e.parent.typeName}/${e.name}`)}function md(n,e){return vt(n,e)}function ig(n,e){function t(i){return i.done===!0?i:{done:i.done,value:md(n,i.value)}}return{[Symbol.asyncIterator](){let i=e[Symbol.asyncIterator](),s={next:()=>i.next().then(t)};return i.throw!==void 0&&(s.throw=r=>i.throw(r).then(t)),i.return!==void 0&&(s.return=r=>i.return(r).then(t)),s}}}function gd(n,e){if(!e)return n;for(let t of e.concat().reverse())n=t(n);return n}function og(n){var e;let t=Object.assign({},n);return(e=t.ignoreUnknownFields)!==null&&e!==void 0||(t.ignoreUnknownFields=!0),t}function Ka(n,e,t,i){let s=e?sg(n.input,i):rg(n.input,t);return{parse:(e?sg(n.output,i):rg(n.output,t)).parse,serialize:s.serialize}}function sg(n,e){return{parse(t){try{return jn(n,t,e)}catch(i){let s=i instanceof Error?i.message:String(i);throw new Ve(`parse binary: ${s}`,Ae.Internal)}},serialize(t){try{return Vs(n,t,e)}catch(i){let s=i instanceof Error?i.message:String(i);throw new Ve(`serialize binary: ${s}`,Ae.Internal)}}}}function rg(n,e){var t,i;let s=(t=e?.textEncoder)!==null&&t!==void 0?t:new TextEncoder,r=(i=e?.textDecoder)!==null&&i!==void 0?i:new TextDecoder,o=og(e);return{parse(a){try{let l=r.decode(a);return Dm(n,l,o)}catch(l){throw Ve.from(l,Ae.InvalidArgument)}},serialize(a){try{let l=Im(n,a,o);return s.encode(l)}catch(l){throw Ve.from(l,Ae.Internal)}}}}function yd(n){let e=gd(n.next,n.interceptors),[t,i,s]=ag(n),r=Object.assign(Object.assign({},n.req),{message:md(n.req.method.input,n.req.message),signal:t});return e(r).then(o=>(s(),o),i)}function bd(n){let e=gd(n.next,n.interceptors),[t,i,s]=ag(n),r=Object.assign(Object.assign({},n.req),{message:ig(n.req.method.input,n.req.message),signal:t}),o=!1;return t.addEventListener("abort",function(){var a,l;let c=n.req.message[Symbol.asyncIterator]();o||(a=c.throw)===null||a===void 0||a.call(c,this.reason).catch(()=>{}),(l=c.return)===null||l===void 0||l.call(c).catch(()=>{})}),e(r).then(a=>Object.assign(Object.assign({},a),{message:{[Symbol.asyncIterator](){let l=a.message[Symbol.asyncIterator]();return{next(){return!o&&t.aborted?i(Xa(t)):l.next().then(c=>(c.done==!0&&(o=!0,s()),c),i)}}}}}),i)}function ag(n){let{signal:e,cleanup:t}=Km(n.timeoutMs),i=Qm(n.signal,e);return[i.signal,function(r){let o=i.signal.aborted?Ve.from(Xa(i.signal),Ae.Canceled):Ve.from(r);return i.abort(o),t(),Promise.reject(o)},function(){t(),i.abort()}]}function lg(){try{new Headers}catch{throw new Error("connect-web requires the fetch API. Are you running on an old version of Node.js? Node.js is not supported in Connect for Web - please stay tuned for Connect for Node.")}}function to(n,e){let t=Ja(n);if(t)throw e.forEach((i,s)=>{t.metadata.append(s,i)}),t;if(!e.has(ei)&&!n.has(ei))throw new Ve("protocol error: missing status",Ae.Internal)}function qa(n,e,t,i){var s,r;let o=new Headers(t??{});o.set(dd,n?$m:eg),o.set(jm,"1");let a=(r=(s=o.get(Ya))!==null&&s!==void 0?s:o.get(fd))!==null&&r!==void 0?r:"connect-es/2.2.0";return o.set(fd,a),i&&o.set(Ya,a),e!==void 0&&o.set(hd,`${e}m`),o}function cg(n){switch(n){case 400:return Ae.Internal;case 401:return Ae.Unauthenticated;case 403:return Ae.PermissionDenied;case 404:return Ae.Unimplemented;case 429:return Ae.Unavailable;case 502:return Ae.Unavailable;case 503:return Ae.Unavailable;case 504:return Ae.Unavailable;default:return Ae.Unknown}}function ja(n,e){var t;if(n>=200&&n<300)return{foundStatus:e.has(ei),headerError:Ja(e)};throw new Ve(decodeURIComponent((t=e.get(eo))!==null&&t!==void 0?t:`HTTP ${n}`),cg(n),e)}var ys=function(n){return this instanceof ys?(this.v=n,this):new ys(n)},IS=function(n,e,t){if(!Symbol.asyncIterator)throw new TypeError("Symbol.asyncIterator is not defined.");var i=t.apply(n,e||[]),s,r=[];return s=Object.create((typeof AsyncIterator=="function"?AsyncIterator:Object).prototype),a("next"),a("throw"),a("return",o),s[Symbol.asyncIterator]=function(){return this},s;function o(d){return function(f){return Promise.resolve(f).then(d,h)}}function a(d,f){i[d]&&(s[d]=function(b){return new Promise(function(g,m){r.push([d,b,g,m])>1||l(d,b)})},f&&(s[d]=f(s[d])))}function l(d,f){try{c(i[d](f))}catch(b){p(r[0][3],b)}}function c(d){d.value instanceof ys?Promise.resolve(d.value.v).then(u,h):p(r[0][2],d)}function u(d){l("next",d)}function h(d){l("throw",d)}function p(d,f){d(f),r.shift(),r.length&&l(r[0][0],r[0][1])}},ug={redirect:"error"};function xd(n){var e;lg();let t=(e=n.useBinaryFormat)!==null&&e!==void 0?e:!0;return{async unary(i,s,r,o,a,l){let{serialize:c,parse:u}=Ka(i,t,n.jsonOptions,n.binaryOptions);return r=r===void 0?n.defaultTimeoutMs:r<=0?void 0:r,await yd({interceptors:n.interceptors,signal:s,timeoutMs:r,req:{stream:!1,service:i.parent,method:i,requestMethod:"POST",url:Qa(n.baseUrl,i),header:qa(t,r,o,!1),contextValues:l??Za(),message:a},next:async h=>{var p;let f=await((p=n.fetch)!==null&&p!==void 0?p:globalThis.fetch)(h.url,Object.assign(Object.assign({},ug),{method:h.requestMethod,headers:h.header,signal:h.signal,body:za(0,c(h.message))})),{headerError:b}=ja(f.status,f.headers);if(!f.body)throw b!==void 0?b:"missing response body";let g=Wa(f.body).getReader(),m,S;for(;;){let A=await g.read();if(A.done)break;let{flags:_,data:w}=A.value;if((_&ka)===ka)throw new Ve("protocol error: received unsupported compressed output",Ae.Internal);if(_===128){if(m!==void 0)throw"extra trailer";m=Ha(w);continue}if(S!==void 0)throw new Ve("extra message",Ae.Unimplemented);S=u(w)}if(m===void 0)throw b!==void 0?b:new Ve("missing trailer",f.headers.has(ei)?Ae.Unimplemented:Ae.Unknown);if(to(m,f.headers),S===void 0)throw new Ve("missing message",m.has(ei)?Ae.Unimplemented:Ae.Unknown);return{stream:!1,service:i.parent,method:i,header:f.headers,message:S,trailer:m}}})},async stream(i,s,r,o,a,l){let{serialize:c,parse:u}=Ka(i,t,n.jsonOptions,n.binaryOptions);function h(d,f,b,g,m){return IS(this,arguments,function*(){let A=Wa(d).getReader();if(f){if(!(yield ys(A.read())).done)throw"extra data for trailers-only";return yield ys(void 0)}let _=!1;for(;;){let w=yield ys(A.read());if(w.done)break;let{flags:R,data:y}=w.value;if((R&128)===128){if(_)throw"extra trailer";_=!0;let E=Ha(y);to(E,g),E.forEach((L,C)=>b.set(C,L));continue}if(_)throw"extra message";yield yield ys(u(y))}if("throwIfAborted"in m&&m.throwIfAborted(),!_)throw"missing trailer"})}async function p(d){if(i.methodKind!="server_streaming")throw"The fetch API does not support streaming request bodies";let f=await d[Symbol.asyncIterator]().next();if(f.done==!0)throw"missing request message";return za(0,c(f.value))}return r=r===void 0?n.defaultTimeoutMs:r<=0?void 0:r,bd({interceptors:n.interceptors,signal:s,timeoutMs:r,req:{stream:!0,service:i.parent,method:i,requestMethod:"POST",url:Qa(n.baseUrl,i),header:qa(t,r,o,!1),contextValues:l??Za(),message:a},next:async d=>{var f;let g=await((f=n.fetch)!==null&&f!==void 0?f:globalThis.fetch)(d.url,Object.assign(Object.assign({},ug),{method:d.requestMethod,headers:d.header,signal:d.signal,body:await p(d.message)})),{foundStatus:m,headerError:S}=ja(g.status,g.headers);if(S!=null)throw S;if(!g.body)throw"missing response body";let A=new Headers;return Object.assign(Object.assign({},d),{header:g.headers,trailer:A,message:h(g.body,m,A,g.headers,d.signal)})}})}}}var nt=Ie("Ch9nb29nbGUvYXBpL2ZpZWxkX2JlaGF2aW9yLnByb3RvEgpnb29nbGUuYXBpKrYBCg1GaWVsZEJlaGF2aW9yEh4KGkZJRUxEX0JFSEFWSU9SX1VOU1BFQ0lGSUVEEAASDAoIT1BUSU9OQUwQARIMCghSRVFVSVJFRBACEg8KC09VVFBVVF9PTkxZEAMSDgoKSU5QVVRfT05MWRAEEg0KCUlNTVVUQUJMRRAFEhIKDlVOT1JERVJFRF9MSVNUEAYSFQoRTk9OX0VNUFRZX0RFRkFVTFQQBxIOCgpJREVOVElGSUVSEAg6YAoOZmllbGRfYmVoYXZpb3ISHS5nb29nbGUucHJvdG9idWYuRmllbGRPcHRpb25zGJwIIAMoDjIZLmdvb2dsZS5hcGkuRmllbGRCZWhhdmlvclINZmllbGRCZWhhdmlvckJpCg5jb20uZ29vZ2xlLmFwaUISRmllbGRCZWhhdmlvclByb3RvUAFaQWdvb2dsZS5nb2xhbmcub3JnL2dlbnByb3RvL2dvb2dsZWFwaXMvYXBpL2Fubm90YXRpb25zO2Fubm90YXRpb25zYgZwcm90bzM",[gs]);var at=Ie("Chlnb29nbGUvYXBpL3Jlc291cmNlLnByb3RvEgpnb29nbGUuYXBpIu4CChJSZXNvdXJjZURlc2NyaXB0b3ISDAoEdHlwZRgBIAEoCRIPCgdwYXR0ZXJuGAIgAygJEhIKCm5hbWVfZmllbGQYAyABKAkSNwoHaGlzdG9yeRgEIAEoDjImLmdvb2dsZS5hcGkuUmVzb3VyY2VEZXNjcmlwdG9yLkhpc3RvcnkSDgoGcGx1cmFsGAUgASgJEhAKCHNpbmd1bGFyGAYgASgJEjMKBXN0eWxlGAogAygOMiQuZ29vZ2xlLmFwaS5SZXNvdXJjZURlc2NyaXB0b3IuU3R5bGUiWwoHSGlzdG9yeRIXChNISVNUT1JZX1VOU1BFQ0lGSUVEEAASHQoZT1JJR0lOQUxMWV9TSU5HTEVfUEFUVEVSThABEhgKFEZVVFVSRV9NVUxUSV9QQVRURVJOEAIiOAoFU3R5bGUSFQoRU1RZTEVfVU5TUEVDSUZJRUQQABIYChRERUNMQVJBVElWRV9GUklFTkRMWRABIjUKEVJlc291cmNlUmVmZXJlbmNlEgwKBHR5cGUYASABKAkSEgoKY2hpbGRfdHlwZRgCIAEoCTpsChJyZXNvdXJjZV9yZWZlcmVuY2USHS5nb29nbGUucHJvdG9idWYuRmllbGRPcHRpb25zGJ8IIAEoCzIdLmdvb2dsZS5hcGkuUmVzb3VyY2VSZWZlcmVuY2VSEXJlc291cmNlUmVmZXJlbmNlOm4KE3Jlc291cmNlX2RlZmluaXRpb24SHC5nb29nbGUucHJvdG9idWYuRmlsZU9wdGlvbnMYnQggAygLMh4uZ29vZ2xlLmFwaS5SZXNvdXJjZURlc2NyaXB0b3JSEnJlc291cmNlRGVmaW5pdGlvbjpcCghyZXNvdXJjZRIfLmdvb2dsZS5wcm90b2J1Zi5NZXNzYWdlT3B0aW9ucxidCCABKAsyHi5nb29nbGUuYXBpLlJlc291cmNlRGVzY3JpcHRvclIIcmVzb3VyY2VCZAoOY29tLmdvb2dsZS5hcGlCDVJlc291cmNlUHJvdG9QAVpBZ29vZ2xlLmdvbGFuZy5vcmcvZ2VucHJvdG8vZ29vZ2xlYXBpcy9hcGkvYW5ub3RhdGlvbnM7YW5ub3RhdGlvbnNiBnByb3RvMw",[gs]);var lt=Ie("ChZzaW5ldy92MS9vcHRpb25zLnByb3RvEghzaW5ldy52MSqYAQoEUm9sZRIUChBST0xFX1VOU1BFQ0lGSUVEEAASDwoLUk9MRV9WSUVXRVIQARISCg5ST0xFX1BFUlRVUkJFUhACEg8KC1JPTEVfRFJJVkVSEAMSEQoNUk9MRV9ESVJFQ1RPUhAEEg4KClJPTEVfT1dORVIQBRIPCgtST0xFX01FTUJFUhAGEhAKDFJPTEVfQ1JFQVRPUhAHOlUKDXJlcXVpcmVkX3JvbGUSHi5nb29nbGUucHJvdG9idWYuTWV0aG9kT3B0aW9ucxiNjAMgASgOMg4uc2luZXcudjEuUm9sZVIMcmVxdWlyZWRSb2xlYgZwcm90bzM",[gs]);var NS=Ie("ChVzaW5ldy92MS9hY2Nlc3MucHJvdG8SCHNpbmV3LnYxIoYDCgVHcmFudBISCgRuYW1lGAEgASgJQgTiQQEIEhgKCXByaW5jaXBhbBgCIAEoCUIF4kECAgUSIwoFcm9sZXMYAyADKA4yDi5zaW5ldy52MS5Sb2xlQgTiQQECEhgKCmZpZ3VyZV9pZHMYBCADKAlCBOJBAQESMgoGYm91bmRzGAUgASgLMhwuc2luZXcudjEuUGVydHVyYmF0aW9uQm91bmRzQgTiQQEBEhoKDG1heF9wcmlvcml0eRgGIAEoBUIE4kEBARI1CgtjcmVhdGVfdGltZRgHIAEoCzIaLmdvb2dsZS5wcm90b2J1Zi5UaW1lc3RhbXBCBOJBAQMSNQoLZXhwaXJlX3RpbWUYCCABKAsyGi5nb29nbGUucHJvdG9idWYuVGltZXN0YW1wQgTiQQEBEhIKBGV0YWcYCSABKAlCBOJBAQE6PupBOwoLc2luZXcvR3JhbnQSHXdvcmxkcy97d29ybGR9L2dyYW50cy97Z3JhbnR9KgZncmFudHMyBWdyYW50IrABChJQZXJ0dXJiYXRpb25Cb3VuZHMSJAoRbWF4X2ZvcmNlX25ld3RvbnMYASABKAFCBOJBAQFIAIgBARIeCgttYXhfbWFzc19rZxgCIAEoAUIE4kEBAUgBiAEBEh4KC21heF9yYXRlX2h6GAMgASgBQgTiQQEBSAKIAQFCFAoSX21heF9mb3JjZV9uZXd0b25zQg4KDF9tYXhfbWFzc19rZ0IOCgxfbWF4X3JhdGVfaHoiNwoQR2V0Q2FsbGVyUmVxdWVzdBIjCgV3b3JsZBgBIAEoCUIU4kEBAfpBDQoLc2luZXcvV29ybGQidgoRR2V0Q2FsbGVyUmVzcG9uc2USEQoJcHJpbmNpcGFsGAEgASgJEh0KBXJvbGVzGAIgAygOMg4uc2luZXcudjEuUm9sZRIvCgtleHBpcmVfdGltZRgDIAEoCzIaLmdvb2dsZS5wcm90b2J1Zi5UaW1lc3RhbXAirwEKEkNyZWF0ZUdyYW50UmVxdWVzdBIkCgZwYXJlbnQYASABKAlCFOJBAQL6QQ0SC3NpbmV3L0dyYW50EhYKCGdyYW50X2lkGAIgASgJQgTiQQEBEiQKBWdyYW50GAMgASgLMg8uc2luZXcudjEuR3JhbnRCBOJBAQISGAoKcmVxdWVzdF9pZBgNIAEoCUIE4kEBARIbCg12YWxpZGF0ZV9vbmx5GA4gASgIQgTiQQEBIjUKE0NyZWF0ZUdyYW50UmVzcG9uc2USHgoFZ3JhbnQYASABKAsyDy5zaW5ldy52MS5HcmFudCI1Cg9HZXRHcmFudFJlcXVlc3QSIgoEbmFtZRgBIAEoCUIU4kEBAvpBDQoLc2luZXcvR3JhbnQiMgoQR2V0R3JhbnRSZXNwb25zZRIeCgVncmFudBgBIAEoCzIPLnNpbmV3LnYxLkdyYW50ImwKEUxpc3RHcmFudHNSZXF1ZXN0EiQKBnBhcmVudBgBIAEoCUIU4kEBAvpBDRILc2luZXcvR3JhbnQSFwoJcGFnZV9zaXplGAIgASgFQgTiQQEBEhgKCnBhZ2VfdG9rZW4YAyABKAlCBOJBAQEiTgoSTGlzdEdyYW50c1Jlc3BvbnNlEh8KBmdyYW50cxgBIAMoCzIPLnNpbmV3LnYxLkdyYW50EhcKD25leHRfcGFnZV90b2tlbhgCIAEoCSKOAQoSVXBkYXRlR3JhbnRSZXF1ZXN0EiQKBWdyYW50GAEgASgLMg8uc2luZXcudjEuR3JhbnRCBOJBAQISNQoLdXBkYXRlX21hc2sYAiABKAsyGi5nb29nbGUucHJvdG9idWYuRmllbGRNYXNrQgTiQQEBEhsKDXZhbGlkYXRlX29ubHkYDiABKAhCBOJBAQEiNQoTVXBkYXRlR3JhbnRSZXNwb25zZRIeCgVncmFudBgBIAEoCzIPLnNpbmV3LnYxLkdyYW50ImYKEkRlbGV0ZUdyYW50UmVxdWVzdBIiCgRuYW1lGAEgASgJQhTiQQEC+kENCgtzaW5ldy9HcmFudBISCgRldGFnGAwgASgJQgTiQQEBEhgKCnJlcXVlc3RfaWQYDSABKAlCBOJBAQEiFQoTRGVsZXRlR3JhbnRSZXNwb25zZTLpAwoNQWNjZXNzU2VydmljZRJKCglHZXRDYWxsZXISGi5zaW5ldy52MS5HZXRDYWxsZXJSZXF1ZXN0Ghsuc2luZXcudjEuR2V0Q2FsbGVyUmVzcG9uc2UiBOjgGAYSUAoLQ3JlYXRlR3JhbnQSHC5zaW5ldy52MS5DcmVhdGVHcmFudFJlcXVlc3QaHS5zaW5ldy52MS5DcmVhdGVHcmFudFJlc3BvbnNlIgTo4BgFEkcKCEdldEdyYW50Ehkuc2luZXcudjEuR2V0R3JhbnRSZXF1ZXN0Ghouc2luZXcudjEuR2V0R3JhbnRSZXNwb25zZSIE6OAYBRJNCgpMaXN0R3JhbnRzEhsuc2luZXcudjEuTGlzdEdyYW50c1JlcXVlc3QaHC5zaW5ldy52MS5MaXN0R3JhbnRzUmVzcG9uc2UiBOjgGAUSUAoLVXBkYXRlR3JhbnQSHC5zaW5ldy52MS5VcGRhdGVHcmFudFJlcXVlc3QaHS5zaW5ldy52MS5VcGRhdGVHcmFudFJlc3BvbnNlIgTo4BgFElAKC0RlbGV0ZUdyYW50Ehwuc2luZXcudjEuRGVsZXRlR3JhbnRSZXF1ZXN0Gh0uc2luZXcudjEuRGVsZXRlR3JhbnRSZXNwb25zZSIE6OAYBWIGcHJvdG8z",[nt,at,hi,rn,lt]);var hg=ot(NS,0);var on=Ie("ChRzaW5ldy92MS90eXBlcy5wcm90bxIIc2luZXcudjEiKgoHVmVjdG9yMxIJCgF4GAEgASgBEgkKAXkYAiABKAESCQoBehgDIAEoASI4CgpRdWF0ZXJuaW9uEgkKAXgYASABKAESCQoBeRgCIAEoARIJCgF6GAMgASgBEgkKAXcYBCABKAEiYQoEUG9zZRIrCgpwb3NpdGlvbl9tGAEgASgLMhEuc2luZXcudjEuVmVjdG9yM0IE4kEBARIsCghyb3RhdGlvbhgCIAEoCzIULnNpbmV3LnYxLlF1YXRlcm5pb25CBOJBAQEiSAoJUGxhY2VtZW50EhEKA3hfbRgBIAEoAUIE4kEBARIRCgN5X20YAiABKAFCBOJBAQESFQoHeWF3X3JhZBgDIAEoAUIE4kEBASI/CgdOdW1iZXJzEgsKA2YzMhgBIAMoAhILCgNmNjQYAiADKAESCwoDaTE2GAMgASgMEg0KBXNjYWxlGAQgASgCIo8ECg5SZXRhcmdldFJlcG9ydBIlCgZtYXBwZWQYASADKAsyFS5zaW5ldy52MS5Cb25lTWFwcGluZxIVCg1taXNzaW5nX2JvbmVzGAIgAygJEhQKDGJ5X3N0cnVjdHVyZRgDIAEoCBIOCgZ1bml0X20YBCABKAESDwoHdXBfYXhpcxgFIAEoCRIRCglzdGF0dXJlX20YBiABKAESFgoOZmxvb3Jfb2Zmc2V0X20YByABKAESJwoHY2xhbXBlZBgIIAMoCzIWLnNpbmV3LnYxLkNsYW1wZWRBbmdsZRIbChNmb290X3NsaWRlX2JlZm9yZV9tGAkgASgBEhoKEmZvb3Rfc2xpZGVfYWZ0ZXJfbRgKIAEoARIbChNicmlkZ2VkX2ZyYW1lX2NvdW50GAsgASgFEi4KDmNvbnRhY3RfcGhhc2VzGAwgAygLMhYuc2luZXcudjEuQ29udGFjdFBoYXNlEhAKCHdhcm5pbmdzGA0gAygJEhsKE2Ryb3BwZWRfZnJhbWVfY291bnQYDiABKAUSDQoFc2NhbGUYDyABKAESFgoOc291cmNlX3JhdGVfaHoYECABKAESFQoNc2lkZXNfc3dhcHBlZBgRIAEoCBIaCg1ydW5fc3BlZWRfbXBzGBIgASgBSACIAQESEwoLcnVuc193YWxrZWQYEyABKAhCEAoOX3J1bl9zcGVlZF9tcHMiKwoLQm9uZU1hcHBpbmcSDAoEYm9uZRgBIAEoCRIOCgZqb2ludHMYAiADKAkiRQoMQ2xhbXBlZEFuZ2xlEgsKA2RvZhgBIAEoCRIQCghmcmFjdGlvbhgCIAEoARIWCg5tYXhfZXhjZXNzX3JhZBgDIAEoASI8CgxDb250YWN0UGhhc2USDAoEbGVmdBgBIAEoCBIPCgdzdGFydF9zGAIgASgBEg0KBWVuZF9zGAMgASgBKmMKCEVuY29kaW5nEhgKFEVOQ09ESU5HX1VOU1BFQ0lGSUVEEAASEgoORU5DT0RJTkdfRkxPQVQQARITCg9FTkNPRElOR19ET1VCTEUQAhIUChBFTkNPRElOR19GSVhFRDE2EANiBnByb3RvMw",[nt]);var vd=Ie("ChNzaW5ldy92MS9ib2R5LnByb3RvEghzaW5ldy52MSJ3CgtCb2R5UHJvZmlsZRIgCgNzZXgYASABKA4yDS5zaW5ldy52MS5TZXhCBOJBAQISFwoJYWdlX3llYXJzGAIgASgBQgTiQQEBEhYKCGhlaWdodF9tGAMgASgBQgTiQQEBEhUKB21hc3Nfa2cYBCABKAFCBOJBAQEi6wEKB1NlZ21lbnQSDAoEbmFtZRgBIAEoCRIMCgRib25lGAIgASgJEg4KBnBhcmVudBgDIAEoBRIPCgdtYXNzX2tnGAQgASgBEiAKBWNvbV9tGAUgASgLMhEuc2luZXcudjEuVmVjdG9yMxIUCgxpbmVydGlhX2tnbTIYBiADKAESIAoFdGlwX20YByABKAsyES5zaW5ldy52MS5WZWN0b3IzEhgKEGNvbnRhY3RfcG9pbnRzX20YCCADKAESFwoPbWVzaF92ZXJ0aWNlc19tGAkgAygBEhYKDm1lc2hfdHJpYW5nbGVzGAogAygFIoMBCgVKb2ludBIMCgRuYW1lGAEgASgJEiEKBHR5cGUYAiABKA4yEy5zaW5ldy52MS5Kb2ludFR5cGUSIwoIb2Zmc2V0X20YAyABKAsyES5zaW5ldy52MS5WZWN0b3IzEhEKCWRvZl9zdGFydBgEIAEoBRIRCglkb2ZfY291bnQYBSABKAUigAEKA0RvZhIMCgRuYW1lGAEgASgJEg0KBWpvaW50GAIgASgFEh8KBGF4aXMYAyABKAsyES5zaW5ldy52MS5WZWN0b3IzEhEKCWxvd2VyX3JhZBgEIAEoARIRCgl1cHBlcl9yYWQYBSABKAESFQoNYXJtYXR1cmVfa2dtMhgGIAEoASLBAgoEQm9keRISCgRuYW1lGAEgASgJQgTiQQEIEiwKB3Byb2ZpbGUYAiABKAsyFS5zaW5ldy52MS5Cb2R5UHJvZmlsZUIE4kEBAxIpCghzZWdtZW50cxgDIAMoCzIRLnNpbmV3LnYxLlNlZ21lbnRCBOJBAQMSJQoGam9pbnRzGAQgAygLMg8uc2luZXcudjEuSm9pbnRCBOJBAQMSIQoEZG9mcxgFIAMoCzINLnNpbmV3LnYxLkRvZkIE4kEBAxIkChZzdGFuZGluZ19yb290X2hlaWdodF9tGAYgASgBQgTiQQEDEi4KCnByb3ZlbmFuY2UYByADKAsyFC5zaW5ldy52MS5Qcm92ZW5hbmNlQgTiQQEDOizqQSkKCnNpbmV3L0JvZHkSDWJvZGllcy97Ym9keX0qBmJvZGllczIEYm9keSKEAQoKUHJvdmVuYW5jZRIMCgRwYXJ0GAEgASgJEg4KBmFjdGlvbhgCIAEoCRIQCghxdWFudGl0eRgDIAEoCRINCgV2YWx1ZRgEIAEoARIMCgR1bml0GAUgASgJEg4KBnNvdXJjZRgGIAEoCRILCgN0YWcYByABKAkSDAoEbm90ZRgIIAEoCSJGChFMaXN0Qm9kaWVzUmVxdWVzdBIXCglwYWdlX3NpemUYASABKAVCBOJBAQESGAoKcGFnZV90b2tlbhgCIAEoCUIE4kEBASJNChJMaXN0Qm9kaWVzUmVzcG9uc2USHgoGYm9kaWVzGAEgAygLMg4uc2luZXcudjEuQm9keRIXCg9uZXh0X3BhZ2VfdG9rZW4YAiABKAkidQoOR2V0Qm9keVJlcXVlc3QSIQoEbmFtZRgBIAEoCUIT4kEBAvpBDAoKc2luZXcvQm9keRIeChBpbmNsdWRlX2dlb21ldHJ5GAIgASgIQgTiQQEBEiAKEmluY2x1ZGVfcHJvdmVuYW5jZRgDIAEoCEIE4kEBASIvCg9HZXRCb2R5UmVzcG9uc2USHAoEYm9keRgBIAEoCzIOLnNpbmV3LnYxLkJvZHkiZAoRRXhwb3J0Qm9keVJlcXVlc3QSIQoEbmFtZRgBIAEoCUIT4kEBAvpBDAoKc2luZXcvQm9keRIsCgZmb3JtYXQYAiABKA4yFi5zaW5ldy52MS5FeHBvcnRGb3JtYXRCBOJBAQIiNQoSRXhwb3J0Qm9keVJlc3BvbnNlEgwKBHRleHQYASABKAkSEQoJZmlsZV9uYW1lGAIgASgJKjgKA1NleBITCg9TRVhfVU5TUEVDSUZJRUQQABIMCghTRVhfTUFMRRABEg4KClNFWF9GRU1BTEUQAipnCglKb2ludFR5cGUSGgoWSk9JTlRfVFlQRV9VTlNQRUNJRklFRBAAEhMKD0pPSU5UX1RZUEVfRlJFRRABEhMKD0pPSU5UX1RZUEVfQkFMTBACEhQKEEpPSU5UX1RZUEVfSElOR0UQAypdCgxFeHBvcnRGb3JtYXQSHQoZRVhQT1JUX0ZPUk1BVF9VTlNQRUNJRklFRBAAEhYKEkVYUE9SVF9GT1JNQVRfTUpDRhABEhYKEkVYUE9SVF9GT1JNQVRfVVJERhACMvEBCgtCb2R5U2VydmljZRJNCgpMaXN0Qm9kaWVzEhsuc2luZXcudjEuTGlzdEJvZGllc1JlcXVlc3QaHC5zaW5ldy52MS5MaXN0Qm9kaWVzUmVzcG9uc2UiBOjgGAYSRAoHR2V0Qm9keRIYLnNpbmV3LnYxLkdldEJvZHlSZXF1ZXN0Ghkuc2luZXcudjEuR2V0Qm9keVJlc3BvbnNlIgTo4BgGEk0KCkV4cG9ydEJvZHkSGy5zaW5ldy52MS5FeHBvcnRCb2R5UmVxdWVzdBocLnNpbmV3LnYxLkV4cG9ydEJvZHlSZXNwb25zZSIE6OAYBmIGcHJvdG8z",[nt,at,lt,on]);var pg=ot(vd,0);var no=Ie("ChRzaW5ldy92MS93b3JsZC5wcm90bxIIc2luZXcudjEitQUKBVdvcmxkEhIKBG5hbWUYASABKAlCBOJBAQgSGgoMZGlzcGxheV9uYW1lGAIgASgJQgTiQQEBEhYKB3JhdGVfaHoYAyABKAFCBeJBAgEFEhwKDXN1YnN0ZXBfY291bnQYBCABKAVCBeJBAgEFEiAKDGdyYXZpdHlfbXBzMhgFIAEoAUIF4kECAQVIAIgBARIcCghmcmljdGlvbhgGIAEoAUIF4kECAQVIAYgBARI1Cg5vdmVycnVuX3BvbGljeRgHIAEoDjIXLnNpbmV3LnYxLk92ZXJydW5Qb2xpY3lCBOJBAQESIQoTY2F0Y2hfdXBfdGlja19jb3VudBgIIAEoBUIE4kEBARITCgVzcGVlZBgJIAEoAUIE4kEBARIpCgVzdGF0ZRgKIAEoDjIULnNpbmV3LnYxLldvcmxkU3RhdGVCBOJBAQMSEgoEdGljaxgLIAEoA0IE4kEBAxIUCgZ0aW1lX3MYDCABKAFCBOJBAQMSGgoMZmlndXJlX2NvdW50GA0gASgFQgTiQQEDEhMKBWVwb2NoGA4gASgFQgTiQQEDEjUKC2NyZWF0ZV90aW1lGA8gASgLMhouZ29vZ2xlLnByb3RvYnVmLlRpbWVzdGFtcEIE4kEBAxIVCgdmYWlsdXJlGBAgASgJQgTiQQEDEh4KCmNvbGxpc2lvbnMYESABKAhCBeJBAgEFSAKIAQESMQoIaWRsZV90dGwYEiABKAsyGS5nb29nbGUucHJvdG9idWYuRHVyYXRpb25CBOJBAQESEgoEZXRhZxgTIAEoCUIE4kEBATov6kEsCgtzaW5ldy9Xb3JsZBIOd29ybGRzL3t3b3JsZH0qBndvcmxkczIFd29ybGRCDwoNX2dyYXZpdHlfbXBzMkILCglfZnJpY3Rpb25CDQoLX2NvbGxpc2lvbnMinwEKEkNyZWF0ZVdvcmxkUmVxdWVzdBIWCgh3b3JsZF9pZBgBIAEoCUIE4kEBARIkCgV3b3JsZBgCIAEoCzIPLnNpbmV3LnYxLldvcmxkQgTiQQEBEhQKBnBhdXNlZBgDIAEoCEIE4kEBARIYCgpyZXF1ZXN0X2lkGA0gASgJQgTiQQEBEhsKDXZhbGlkYXRlX29ubHkYDiABKAhCBOJBAQEiNQoTQ3JlYXRlV29ybGRSZXNwb25zZRIeCgV3b3JsZBgBIAEoCzIPLnNpbmV3LnYxLldvcmxkIjUKD0dldFdvcmxkUmVxdWVzdBIiCgRuYW1lGAEgASgJQhTiQQEC+kENCgtzaW5ldy9Xb3JsZCIyChBHZXRXb3JsZFJlc3BvbnNlEh4KBXdvcmxkGAEgASgLMg8uc2luZXcudjEuV29ybGQiRgoRTGlzdFdvcmxkc1JlcXVlc3QSFwoJcGFnZV9zaXplGAEgASgFQgTiQQEBEhgKCnBhZ2VfdG9rZW4YAiABKAlCBOJBAQEiTgoSTGlzdFdvcmxkc1Jlc3BvbnNlEh8KBndvcmxkcxgBIAMoCzIPLnNpbmV3LnYxLldvcmxkEhcKD25leHRfcGFnZV90b2tlbhgCIAEoCSKOAQoSVXBkYXRlV29ybGRSZXF1ZXN0EiQKBXdvcmxkGAEgASgLMg8uc2luZXcudjEuV29ybGRCBOJBAQISNQoLdXBkYXRlX21hc2sYAiABKAsyGi5nb29nbGUucHJvdG9idWYuRmllbGRNYXNrQgTiQQEBEhsKDXZhbGlkYXRlX29ubHkYDiABKAhCBOJBAQEiNQoTVXBkYXRlV29ybGRSZXNwb25zZRIeCgV3b3JsZBgBIAEoCzIPLnNpbmV3LnYxLldvcmxkImYKEkRlbGV0ZVdvcmxkUmVxdWVzdBIiCgRuYW1lGAEgASgJQhTiQQEC+kENCgtzaW5ldy9Xb3JsZBISCgRldGFnGAwgASgJQgTiQQEBEhgKCnJlcXVlc3RfaWQYDSABKAlCBOJBAQEiFQoTRGVsZXRlV29ybGRSZXNwb25zZSI3ChFQYXVzZVdvcmxkUmVxdWVzdBIiCgRuYW1lGAEgASgJQhTiQQEC+kENCgtzaW5ldy9Xb3JsZCI0ChJQYXVzZVdvcmxkUmVzcG9uc2USHgoFd29ybGQYASABKAsyDy5zaW5ldy52MS5Xb3JsZCI4ChJSZXN1bWVXb3JsZFJlcXVlc3QSIgoEbmFtZRgBIAEoCUIU4kEBAvpBDQoLc2luZXcvV29ybGQiNQoTUmVzdW1lV29ybGRSZXNwb25zZRIeCgV3b3JsZBgBIAEoCzIPLnNpbmV3LnYxLldvcmxkImoKEFN0ZXBXb3JsZFJlcXVlc3QSIgoEbmFtZRgBIAEoCUIU4kEBAvpBDQoLc2luZXcvV29ybGQSGAoKdGlja19jb3VudBgCIAEoBUIE4kEBARIYCgpyZXF1ZXN0X2lkGA0gASgJQgTiQQEBIkUKEVN0ZXBXb3JsZFJlc3BvbnNlEgwKBHRpY2sYASABKAMSDgoGdGltZV9zGAIgASgBEhIKCnN0YXRlX2hhc2gYAyABKBAiTwoUU2V0V29ybGRTcGVlZFJlcXVlc3QSIgoEbmFtZRgBIAEoCUIU4kEBAvpBDQoLc2luZXcvV29ybGQSEwoFc3BlZWQYAiABKAFCBOJBAQIiNwoVU2V0V29ybGRTcGVlZFJlc3BvbnNlEh4KBXdvcmxkGAEgASgLMg8uc2luZXcudjEuV29ybGQqgAEKDU92ZXJydW5Qb2xpY3kSHgoaT1ZFUlJVTl9QT0xJQ1lfVU5TUEVDSUZJRUQQABIXChNPVkVSUlVOX1BPTElDWV9TS0lQEAESGwoXT1ZFUlJVTl9QT0xJQ1lfQ0FUQ0hfVVAQAhIZChVPVkVSUlVOX1BPTElDWV9ESUxBVEUQAypyCgpXb3JsZFN0YXRlEhsKF1dPUkxEX1NUQVRFX1VOU1BFQ0lGSUVEEAASFwoTV09STERfU1RBVEVfUlVOTklORxABEhYKEldPUkxEX1NUQVRFX1BBVVNFRBACEhYKEldPUkxEX1NUQVRFX0ZBSUxFRBADMuEFCgxXb3JsZFNlcnZpY2USUAoLQ3JlYXRlV29ybGQSHC5zaW5ldy52MS5DcmVhdGVXb3JsZFJlcXVlc3QaHS5zaW5ldy52MS5DcmVhdGVXb3JsZFJlc3BvbnNlIgTo4BgHEkcKCEdldFdvcmxkEhkuc2luZXcudjEuR2V0V29ybGRSZXF1ZXN0Ghouc2luZXcudjEuR2V0V29ybGRSZXNwb25zZSIE6OAYARJNCgpMaXN0V29ybGRzEhsuc2luZXcudjEuTGlzdFdvcmxkc1JlcXVlc3QaHC5zaW5ldy52MS5MaXN0V29ybGRzUmVzcG9uc2UiBOjgGAYSUAoLVXBkYXRlV29ybGQSHC5zaW5ldy52MS5VcGRhdGVXb3JsZFJlcXVlc3QaHS5zaW5ldy52MS5VcGRhdGVXb3JsZFJlc3BvbnNlIgTo4BgEElAKC0RlbGV0ZVdvcmxkEhwuc2luZXcudjEuRGVsZXRlV29ybGRSZXF1ZXN0Gh0uc2luZXcudjEuRGVsZXRlV29ybGRSZXNwb25zZSIE6OAYBRJNCgpQYXVzZVdvcmxkEhsuc2luZXcudjEuUGF1c2VXb3JsZFJlcXVlc3QaHC5zaW5ldy52MS5QYXVzZVdvcmxkUmVzcG9uc2UiBOjgGAQSUAoLUmVzdW1lV29ybGQSHC5zaW5ldy52MS5SZXN1bWVXb3JsZFJlcXVlc3QaHS5zaW5ldy52MS5SZXN1bWVXb3JsZFJlc3BvbnNlIgTo4BgEEkoKCVN0ZXBXb3JsZBIaLnNpbmV3LnYxLlN0ZXBXb3JsZFJlcXVlc3QaGy5zaW5ldy52MS5TdGVwV29ybGRSZXNwb25zZSIE6OAYBBJWCg1TZXRXb3JsZFNwZWVkEh4uc2luZXcudjEuU2V0V29ybGRTcGVlZFJlcXVlc3QaHy5zaW5ldy52MS5TZXRXb3JsZFNwZWVkUmVzcG9uc2UiBOjgGARiBnByb3RvMw",[nt,at,La,hi,rn,lt]);var fg=ot(no,0);var BS=Ie("ChlzaW5ldy92MS9jaGVja3BvaW50LnByb3RvEghzaW5ldy52MSKOAgoKQ2hlY2twb2ludBISCgRuYW1lGAEgASgJQgTiQQEIEhIKBHRpY2sYAiABKANCBOJBAQMSFAoGdGltZV9zGAMgASgBQgTiQQEDEhgKCnN0YXRlX2hhc2gYBCABKBBCBOJBAQMSGAoKc2l6ZV9ieXRlcxgFIAEoA0IE4kEBAxI1CgtjcmVhdGVfdGltZRgGIAEoCzIaLmdvb2dsZS5wcm90b2J1Zi5UaW1lc3RhbXBCBOJBAQM6V+pBVAoQc2luZXcvQ2hlY2twb2ludBInd29ybGRzL3t3b3JsZH0vY2hlY2twb2ludHMve2NoZWNrcG9pbnR9KgtjaGVja3BvaW50czIKY2hlY2twb2ludCKOAQoWQ2hlY2twb2ludFdvcmxkUmVxdWVzdBIiCgRuYW1lGAEgASgJQhTiQQEC+kENCgtzaW5ldy9Xb3JsZBIbCg1jaGVja3BvaW50X2lkGAIgASgJQgTiQQEBEhkKC3JldHVybl9kYXRhGAMgASgIQgTiQQEBEhgKCnJlcXVlc3RfaWQYDSABKAlCBOJBAQEiUQoXQ2hlY2twb2ludFdvcmxkUmVzcG9uc2USKAoKY2hlY2twb2ludBgBIAEoCzIULnNpbmV3LnYxLkNoZWNrcG9pbnQSDAoEZGF0YRgCIAEoDCJaChRHZXRDaGVja3BvaW50UmVxdWVzdBInCgRuYW1lGAEgASgJQhniQQEC+kESChBzaW5ldy9DaGVja3BvaW50EhkKC3JldHVybl9kYXRhGAIgASgIQgTiQQEBIk8KFUdldENoZWNrcG9pbnRSZXNwb25zZRIoCgpjaGVja3BvaW50GAEgASgLMhQuc2luZXcudjEuQ2hlY2twb2ludBIMCgRkYXRhGAIgASgMInYKFkxpc3RDaGVja3BvaW50c1JlcXVlc3QSKQoGcGFyZW50GAEgASgJQhniQQEC+kESEhBzaW5ldy9DaGVja3BvaW50EhcKCXBhZ2Vfc2l6ZRgCIAEoBUIE4kEBARIYCgpwYWdlX3Rva2VuGAMgASgJQgTiQQEBIl0KF0xpc3RDaGVja3BvaW50c1Jlc3BvbnNlEikKC2NoZWNrcG9pbnRzGAEgAygLMhQuc2luZXcudjEuQ2hlY2twb2ludBIXCg9uZXh0X3BhZ2VfdG9rZW4YAiABKAkiXAoXRGVsZXRlQ2hlY2twb2ludFJlcXVlc3QSJwoEbmFtZRgBIAEoCUIZ4kEBAvpBEgoQc2luZXcvQ2hlY2twb2ludBIYCgpyZXF1ZXN0X2lkGA0gASgJQgTiQQEBIhoKGERlbGV0ZUNoZWNrcG9pbnRSZXNwb25zZSKaAQoTUmVzdG9yZVdvcmxkUmVxdWVzdBIiCgRuYW1lGAEgASgJQhTiQQEC+kENCgtzaW5ldy9Xb3JsZBIrCgpjaGVja3BvaW50GAIgASgJQhX6QRIKEHNpbmV3L0NoZWNrcG9pbnRIABIOCgRkYXRhGAMgASgMSAASGAoKcmVxdWVzdF9pZBgNIAEoCUIE4kEBAUIICgZzb3VyY2UiNgoUUmVzdG9yZVdvcmxkUmVzcG9uc2USHgoFd29ybGQYASABKAsyDy5zaW5ldy52MS5Xb3JsZCLmAQoQRm9ya1dvcmxkUmVxdWVzdBIrCgpjaGVja3BvaW50GAEgASgJQhX6QRIKEHNpbmV3L0NoZWNrcG9pbnRIABIOCgRkYXRhGAIgASgMSAASIQoFd29ybGQYAyABKAlCEPpBDQoLc2luZXcvV29ybGRIABIWCgh3b3JsZF9pZBgEIAEoCUIE4kEBARIUCgZwYXVzZWQYBSABKAhCBOJBAQESFwoEdGljaxgGIAEoA0IE4kEBAUgBiAEBEhgKCnJlcXVlc3RfaWQYDSABKAlCBOJBAQFCCAoGc291cmNlQgcKBV90aWNrIjMKEUZvcmtXb3JsZFJlc3BvbnNlEh4KBXdvcmxkGAEgASgLMg8uc2luZXcudjEuV29ybGQyqQQKEUNoZWNrcG9pbnRTZXJ2aWNlElwKD0NoZWNrcG9pbnRXb3JsZBIgLnNpbmV3LnYxLkNoZWNrcG9pbnRXb3JsZFJlcXVlc3QaIS5zaW5ldy52MS5DaGVja3BvaW50V29ybGRSZXNwb25zZSIE6OAYBBJWCg1HZXRDaGVja3BvaW50Eh4uc2luZXcudjEuR2V0Q2hlY2twb2ludFJlcXVlc3QaHy5zaW5ldy52MS5HZXRDaGVja3BvaW50UmVzcG9uc2UiBOjgGAQSXAoPTGlzdENoZWNrcG9pbnRzEiAuc2luZXcudjEuTGlzdENoZWNrcG9pbnRzUmVxdWVzdBohLnNpbmV3LnYxLkxpc3RDaGVja3BvaW50c1Jlc3BvbnNlIgTo4BgBEl8KEERlbGV0ZUNoZWNrcG9pbnQSIS5zaW5ldy52MS5EZWxldGVDaGVja3BvaW50UmVxdWVzdBoiLnNpbmV3LnYxLkRlbGV0ZUNoZWNrcG9pbnRSZXNwb25zZSIE6OAYBBJTCgxSZXN0b3JlV29ybGQSHS5zaW5ldy52MS5SZXN0b3JlV29ybGRSZXF1ZXN0Gh4uc2luZXcudjEuUmVzdG9yZVdvcmxkUmVzcG9uc2UiBOjgGAQSSgoJRm9ya1dvcmxkEhouc2luZXcudjEuRm9ya1dvcmxkUmVxdWVzdBobLnNpbmV3LnYxLkZvcmtXb3JsZFJlc3BvbnNlIgTo4BgHYgZwcm90bzM",[nt,at,rn,lt,no]);var mg=ot(BS,0);var LS=Ie("ChZzaW5ldy92MS9jb250cm9sLnByb3RvEghzaW5ldy52MSLBAQoMQ29udHJvbExlYXNlEiEKBmZpZ3VyZRgBIAEoCUIR+kEOCgxzaW5ldy9GaWd1cmUSDgoGaG9sZGVyGAIgASgJEhUKDWNvbnRyb2xfZXBvY2gYAyABKAMSEAoIcHJpb3JpdHkYBCABKAUSLwoLZXhwaXJlX3RpbWUYBSABKAsyGi5nb29nbGUucHJvdG9idWYuVGltZXN0YW1wEhAKCGltcGxpY2l0GAYgASgIEhIKCm9mZmVyZWRfdG8YByABKAkipQEKFUFjcXVpcmVDb250cm9sUmVxdWVzdBIlCgZmaWd1cmUYASABKAlCFeJBAQL6QQ4KDHNpbmV3L0ZpZ3VyZRIbCg1jb250cm9sX3Rva2VuGAIgASgJQgTiQQEBEhYKCHByaW9yaXR5GAMgASgFQgTiQQEBEhYKCGdyYWNlX21zGAQgASgBQgTiQQEBEhgKCnJlcXVlc3RfaWQYDSABKAlCBOJBAQEiVgoWQWNxdWlyZUNvbnRyb2xSZXNwb25zZRIlCgVsZWFzZRgBIAEoCzIWLnNpbmV3LnYxLkNvbnRyb2xMZWFzZRIVCg1jb250cm9sX3Rva2VuGAIgASgJInUKFVJlbGVhc2VDb250cm9sUmVxdWVzdBIlCgZmaWd1cmUYASABKAlCFeJBAQL6QQ4KDHNpbmV3L0ZpZ3VyZRIbCg1jb250cm9sX3Rva2VuGAIgASgJQgTiQQECEhgKCnJlcXVlc3RfaWQYDSABKAlCBOJBAQEiGAoWUmVsZWFzZUNvbnRyb2xSZXNwb25zZSK4AQoWVHJhbnNmZXJDb250cm9sUmVxdWVzdBIlCgZmaWd1cmUYASABKAlCFeJBAQL6QQ4KDHNpbmV3L0ZpZ3VyZRIbCg1jb250cm9sX3Rva2VuGAIgASgJQgTiQQECEhAKAnRvGAMgASgJQgTiQQEBEhYKCGJsZW5kX21zGAQgASgBQgTiQQEBEhYKCG9mZmVyX21zGAUgASgBQgTiQQEBEhgKCnJlcXVlc3RfaWQYDSABKAlCBOJBAQEiVQoXVHJhbnNmZXJDb250cm9sUmVzcG9uc2USJQoFbGVhc2UYASABKAsyFi5zaW5ldy52MS5Db250cm9sTGVhc2USEwoLb2ZmZXJfdG9rZW4YAiABKAkiigEKFEFjY2VwdENvbnRyb2xSZXF1ZXN0EiUKBmZpZ3VyZRgBIAEoCUIV4kEBAvpBDgoMc2luZXcvRmlndXJlEhkKC29mZmVyX3Rva2VuGAIgASgJQgTiQQECEhYKCGdyYWNlX21zGAMgASgBQgTiQQEBEhgKCnJlcXVlc3RfaWQYDSABKAlCBOJBAQEiVQoVQWNjZXB0Q29udHJvbFJlc3BvbnNlEiUKBWxlYXNlGAEgASgLMhYuc2luZXcudjEuQ29udHJvbExlYXNlEhUKDWNvbnRyb2xfdG9rZW4YAiABKAkiOgoRR2V0Q29udHJvbFJlcXVlc3QSJQoGZmlndXJlGAEgASgJQhXiQQEC+kEOCgxzaW5ldy9GaWd1cmUiOwoSR2V0Q29udHJvbFJlc3BvbnNlEiUKBWxlYXNlGAEgASgLMhYuc2luZXcudjEuQ29udHJvbExlYXNlMssDCg5Db250cm9sU2VydmljZRJZCg5BY3F1aXJlQ29udHJvbBIfLnNpbmV3LnYxLkFjcXVpcmVDb250cm9sUmVxdWVzdBogLnNpbmV3LnYxLkFjcXVpcmVDb250cm9sUmVzcG9uc2UiBOjgGAMSWQoOUmVsZWFzZUNvbnRyb2wSHy5zaW5ldy52MS5SZWxlYXNlQ29udHJvbFJlcXVlc3QaIC5zaW5ldy52MS5SZWxlYXNlQ29udHJvbFJlc3BvbnNlIgTo4BgDElwKD1RyYW5zZmVyQ29udHJvbBIgLnNpbmV3LnYxLlRyYW5zZmVyQ29udHJvbFJlcXVlc3QaIS5zaW5ldy52MS5UcmFuc2ZlckNvbnRyb2xSZXNwb25zZSIE6OAYAxJWCg1BY2NlcHRDb250cm9sEh4uc2luZXcudjEuQWNjZXB0Q29udHJvbFJlcXVlc3QaHy5zaW5ldy52MS5BY2NlcHRDb250cm9sUmVzcG9uc2UiBOjgGAMSTQoKR2V0Q29udHJvbBIbLnNpbmV3LnYxLkdldENvbnRyb2xSZXF1ZXN0Ghwuc2luZXcudjEuR2V0Q29udHJvbFJlc3BvbnNlIgTo4BgBYgZwcm90bzM",[nt,at,rn,lt]);var gg=ot(LS,0);var Hs=Ie("ChVzaW5ldy92MS9maWd1cmUucHJvdG8SCHNpbmV3LnYxIpoECgxQYXBlck9wdGlvbnMSKwoGcHJlc2V0GAEgASgOMhUuc2luZXcudjEuUGFwZXJQcmVzZXRCBOJBAQESGAoFYWxwaGEYAiABKAFCBOJBAQFIAIgBARIcCglob3Jpem9uX3MYAyABKAFCBOJBAQFIAYgBARIrCgZtZXRyaWMYBCABKA4yFS5zaW5ldy52MS5QYXBlck1ldHJpY0IE4kEBARIvCghwcmlvcml0eRgFIAEoDjIXLnNpbmV3LnYxLlBhcGVyUHJpb3JpdHlCBOJBAQESKQoFc2hhcmUYBiABKA4yFC5zaW5ldy52MS5QYXBlclNoYXJlQgTiQQEBEhsKCHRvX2xpbWl0GAcgASgIQgTiQQEBSAKIAQESFwoEdGlsdBgIIAEoCEIE4kEBAUgDiAEBEh8KDHptcF9mZWFzaWJsZRgJIAEoCEIE4kEBAUgEiAEBEh4KC3RyYWNrX2hhbmRzGAogASgIQgTiQQEBSAWIAQESHAoJdHJhY2tfY29tGAsgASgIQgTiQQEBSAaIAQESHAoJaGFuZF9vdmVyGAwgASgIQgTiQQEBSAeIAQFCCAoGX2FscGhhQgwKCl9ob3Jpem9uX3NCCwoJX3RvX2xpbWl0QgcKBV90aWx0Qg8KDV96bXBfZmVhc2libGVCDgoMX3RyYWNrX2hhbmRzQgwKCl90cmFja19jb21CDAoKX2hhbmRfb3ZlciKNAQoNU3RyZW5ndGhTY2FsZRIRCgNhbGwYASABKAFCBOJBAQESKQoEZG9mcxgCIAMoCzIVLnNpbmV3LnYxLkRvZlN0cmVuZ3RoQgTiQQEBEhgKCnBlcmNlbnRpbGUYAyABKAFCBOJBAQESGQoGZWZmb3J0GAQgASgBQgTiQQEBSACIAQFCCQoHX2VmZm9ydCI2CgtEb2ZTdHJlbmd0aBIRCgNkb2YYASABKAlCBOJBAQISFAoGZmFjdG9yGAIgASgBQgTiQQECIlMKC0NhcnJpZWRMb2FkEg8KB3NlZ21lbnQYASABKAUSIgoHcG9pbnRfbRgCIAEoCzIRLnNpbmV3LnYxLlZlY3RvcjMSDwoHbWFzc19rZxgDIAEoASKcBQoGRmlndXJlEhIKBG5hbWUYASABKAlCBOJBAQgSGgoMZGlzcGxheV9uYW1lGAIgASgJQgTiQQEBEiIKBGJvZHkYAyABKAlCFOJBAgEF+kEMCgpzaW5ldy9Cb2R5Ei0KB3Byb2ZpbGUYBCABKAsyFS5zaW5ldy52MS5Cb2R5UHJvZmlsZUIF4kECAQUSLwoIc3RyZW5ndGgYBSABKAsyFy5zaW5ldy52MS5TdHJlbmd0aFNjYWxlQgTiQQEBEi4KCmNvbnRyb2xsZXIYBiABKA4yFC5zaW5ldy52MS5Db250cm9sbGVyQgTiQQEBEikKB3N0ZXBwZXIYByABKA4yES5zaW5ldy52MS5TdGVwcGVyQgXiQQIBBRIsCglwbGFjZW1lbnQYCCABKAsyEy5zaW5ldy52MS5QbGFjZW1lbnRCBOJBAQESIAoSZmF0aWd1ZV90aW1lX3NjYWxlGAogASgBQgTiQQEBEhQKBmFzc2lzdBgLIAEoAUIE4kEBARIrCgVwYXBlchgMIAEoCzIWLnNpbmV3LnYxLlBhcGVyT3B0aW9uc0IE4kEBARIvCgtjb25zdHJhaW50cxgNIAMoCzIULnNpbmV3LnYxLkNvbnN0cmFpbnRCBOJBAQESIwoQcHJvdGVjdGl2ZV9zdGVwcxgOIAEoCEIE4kEBAUgAiAEBEiwKBnN0YXR1cxgJIAEoCzIWLnNpbmV3LnYxLkZpZ3VyZVN0YXR1c0IE4kEBAxISCgRldGFnGA8gASgJQgTiQQEBOkPqQUAKDHNpbmV3L0ZpZ3VyZRIfd29ybGRzL3t3b3JsZH0vZmlndXJlcy97ZmlndXJlfSoHZmlndXJlczIGZmlndXJlQhMKEV9wcm90ZWN0aXZlX3N0ZXBzInoKDEZpZ3VyZVN0YXR1cxIdCgRjbGlwGAEgASgJQg/6QQwKCnNpbmV3L0NsaXASIgoJbmV4dF9jbGlwGAIgASgJQg/6QQwKCnNpbmV3L0NsaXASEQoJZHJpdmVyX2lkGAMgASgJEhQKDGZpZ3VyZV9pbmRleBgEIAEoBSLaAgoKQ29uc3RyYWludBIRCgdzZWdtZW50GAEgASgJSAASGAoOY2VudGVyX29mX21hc3MYAiABKAhIABIoCgdwb2ludF9tGAMgASgLMhEuc2luZXcudjEuVmVjdG9yM0IE4kEBARIrCgpwb3NpdGlvbl9tGAQgASgLMhEuc2luZXcudjEuVmVjdG9yM0IE4kEBARIuCg1wb3NpdGlvbl9heGVzGAUgASgLMhEuc2luZXcudjEuVmVjdG9yM0IE4kEBARIsCghyb3RhdGlvbhgGIAEoCzIULnNpbmV3LnYxLlF1YXRlcm5pb25CBOJBAQESGQoGd2VpZ2h0GAcgASgBQgTiQQEBSAGIAQESGQoGZWFzZV9zGAggASgBQgTiQQEBSAKIAQESGAoKZHVyYXRpb25fcxgJIAEoAUIE4kEBAUIECgJvbkIJCgdfd2VpZ2h0QgkKB19lYXNlX3MitAEKE0NyZWF0ZUZpZ3VyZVJlcXVlc3QSJQoGcGFyZW50GAEgASgJQhXiQQEC+kEOEgxzaW5ldy9GaWd1cmUSFwoJZmlndXJlX2lkGAIgASgJQgTiQQEBEiYKBmZpZ3VyZRgDIAEoCzIQLnNpbmV3LnYxLkZpZ3VyZUIE4kEBARIYCgpyZXF1ZXN0X2lkGA0gASgJQgTiQQEBEhsKDXZhbGlkYXRlX29ubHkYDiABKAhCBOJBAQEiOAoUQ3JlYXRlRmlndXJlUmVzcG9uc2USIAoGZmlndXJlGAEgASgLMhAuc2luZXcudjEuRmlndXJlIjcKEEdldEZpZ3VyZVJlcXVlc3QSIwoEbmFtZRgBIAEoCUIV4kEBAvpBDgoMc2luZXcvRmlndXJlIjUKEUdldEZpZ3VyZVJlc3BvbnNlEiAKBmZpZ3VyZRgBIAEoCzIQLnNpbmV3LnYxLkZpZ3VyZSJuChJMaXN0RmlndXJlc1JlcXVlc3QSJQoGcGFyZW50GAEgASgJQhXiQQEC+kEOEgxzaW5ldy9GaWd1cmUSFwoJcGFnZV9zaXplGAIgASgFQgTiQQEBEhgKCnBhZ2VfdG9rZW4YAyABKAlCBOJBAQEiUQoTTGlzdEZpZ3VyZXNSZXNwb25zZRIhCgdmaWd1cmVzGAEgAygLMhAuc2luZXcudjEuRmlndXJlEhcKD25leHRfcGFnZV90b2tlbhgCIAEoCSKuAQoTVXBkYXRlRmlndXJlUmVxdWVzdBImCgZmaWd1cmUYASABKAsyEC5zaW5ldy52MS5GaWd1cmVCBOJBAQISNQoLdXBkYXRlX21hc2sYAiABKAsyGi5nb29nbGUucHJvdG9idWYuRmllbGRNYXNrQgTiQQEBEhsKDXZhbGlkYXRlX29ubHkYDiABKAhCBOJBAQESGwoNY29udHJvbF90b2tlbhgPIAEoCUIE4kEBASI4ChRVcGRhdGVGaWd1cmVSZXNwb25zZRIgCgZmaWd1cmUYASABKAsyEC5zaW5ldy52MS5GaWd1cmUiaAoTRGVsZXRlRmlndXJlUmVxdWVzdBIjCgRuYW1lGAEgASgJQhXiQQEC+kEOCgxzaW5ldy9GaWd1cmUSEgoEZXRhZxgMIAEoCUIE4kEBARIYCgpyZXF1ZXN0X2lkGA0gASgJQgTiQQEBIhYKFERlbGV0ZUZpZ3VyZVJlc3BvbnNlIp4BChJSZXNldEZpZ3VyZVJlcXVlc3QSIwoEbmFtZRgBIAEoCUIV4kEBAvpBDgoMc2luZXcvRmlndXJlEiwKCXBsYWNlbWVudBgCIAEoCzITLnNpbmV3LnYxLlBsYWNlbWVudEIE4kEBARIYCgpyZXF1ZXN0X2lkGA0gASgJQgTiQQEBEhsKDWNvbnRyb2xfdG9rZW4YDyABKAlCBOJBAQEiNwoTUmVzZXRGaWd1cmVSZXNwb25zZRIgCgZmaWd1cmUYASABKAsyEC5zaW5ldy52MS5GaWd1cmUqbAoKQ29udHJvbGxlchIaChZDT05UUk9MTEVSX1VOU1BFQ0lGSUVEEAASFAoQQ09OVFJPTExFUl9QQVBFUhABEhUKEUNPTlRST0xMRVJfTU9ERVJOEAISFQoRQ09OVFJPTExFUl9NT1RPUlMQAypNCgdTdGVwcGVyEhcKE1NURVBQRVJfVU5TUEVDSUZJRUQQABISCg5TVEVQUEVSX1RPUlFVRRABEhUKEVNURVBQRVJfS0lORU1BVElDEAIqYAoLUGFwZXJQcmVzZXQSHAoYUEFQRVJfUFJFU0VUX1VOU1BFQ0lGSUVEEAASHAoYUEFQRVJfUFJFU0VUX1NBRkVHVUFSREVEEAESFQoRUEFQRVJfUFJFU0VUXzIwMDAQAip5CgtQYXBlck1ldHJpYxIcChhQQVBFUl9NRVRSSUNfVU5TUEVDSUZJRUQQABIZChVQQVBFUl9NRVRSSUNfSURFTlRJVFkQARIYChRQQVBFUl9NRVRSSUNfSU5FUlRJQRACEhcKE1BBUEVSX01FVFJJQ19UT1JRVUUQAypmCg1QYXBlclByaW9yaXR5Eh4KGlBBUEVSX1BSSU9SSVRZX1VOU1BFQ0lGSUVEEAASGgoWUEFQRVJfUFJJT1JJVFlfUFJJTlRFRBABEhkKFVBBUEVSX1BSSU9SSVRZX05FU1RFRBACKloKClBhcGVyU2hhcmUSGwoXUEFQRVJfU0hBUkVfVU5TUEVDSUZJRUQQABIVChFQQVBFUl9TSEFSRV9SQVRJTxABEhgKFFBBUEVSX1NIQVJFX0JBTEFOQ0VEEAIy/gMKDUZpZ3VyZVNlcnZpY2USUwoMQ3JlYXRlRmlndXJlEh0uc2luZXcudjEuQ3JlYXRlRmlndXJlUmVxdWVzdBoeLnNpbmV3LnYxLkNyZWF0ZUZpZ3VyZVJlc3BvbnNlIgTo4BgEEkoKCUdldEZpZ3VyZRIaLnNpbmV3LnYxLkdldEZpZ3VyZVJlcXVlc3QaGy5zaW5ldy52MS5HZXRGaWd1cmVSZXNwb25zZSIE6OAYARJQCgtMaXN0RmlndXJlcxIcLnNpbmV3LnYxLkxpc3RGaWd1cmVzUmVxdWVzdBodLnNpbmV3LnYxLkxpc3RGaWd1cmVzUmVzcG9uc2UiBOjgGAESUwoMVXBkYXRlRmlndXJlEh0uc2luZXcudjEuVXBkYXRlRmlndXJlUmVxdWVzdBoeLnNpbmV3LnYxLlVwZGF0ZUZpZ3VyZVJlc3BvbnNlIgTo4BgDElMKDERlbGV0ZUZpZ3VyZRIdLnNpbmV3LnYxLkRlbGV0ZUZpZ3VyZVJlcXVlc3QaHi5zaW5ldy52MS5EZWxldGVGaWd1cmVSZXNwb25zZSIE6OAYBBJQCgtSZXNldEZpZ3VyZRIcLnNpbmV3LnYxLlJlc2V0RmlndXJlUmVxdWVzdBodLnNpbmV3LnYxLlJlc2V0RmlndXJlUmVzcG9uc2UiBOjgGANiBnByb3RvMw",[nt,at,hi,vd,lt,on]);var yg=rt(Hs,4);var io=(s=>(s[s.UNSPECIFIED=0]="UNSPECIFIED",s[s.PAPER=1]="PAPER",s[s.MODERN=2]="MODERN",s[s.MOTORS=3]="MOTORS",s))(io||{});var bg=ot(Hs,0);var Ys=Ie("ChRzaW5ldy92MS9mcmFtZS5wcm90bxIIc2luZXcudjEi0QEKCldvcmxkRnJhbWUSDAoEdGljaxgBIAEoAxIOCgZ0aW1lX3MYAiABKAESEgoKc3RhdGVfaGFzaBgDIAEoEBINCgVlcG9jaBgEIAEoBRIWCg5zZXJ2ZXJfdGltZV9ucxgFIAEoEBIWCg5yb3N0ZXJfdmVyc2lvbhgGIAEoBRImCgdmaWd1cmVzGAcgAygLMhUuc2luZXcudjEuRmlndXJlRnJhbWUSKgoJb2JzdGFjbGVzGAggAygLMhcuc2luZXcudjEuT2JzdGFjbGVGcmFtZSKMAQoNT2JzdGFjbGVGcmFtZRITCgtvYnN0YWNsZV9pZBgBIAEoCRIfCgRwb3NlGAIgASgLMhEuc2luZXcudjEuTnVtYmVycxIjCgh2ZWxvY2l0eRgDIAEoCzIRLnNpbmV3LnYxLk51bWJlcnMSIAoFZm9yY2UYBCABKAsyES5zaW5ldy52MS5OdW1iZXJzIsMGCgtGaWd1cmVGcmFtZRIUCgxmaWd1cmVfaW5kZXgYASABKAUSGAoQYXBwbGllZF9zZXF1ZW5jZRgCIAEoAxIeChZhcHBsaWVkX3NvdXJjZV90aW1lX25zGAMgASgQEiQKCXJvb3RfcG9zZRgEIAEoCzIRLnNpbmV3LnYxLk51bWJlcnMSJwoMam9pbnRfYW5nbGVzGAUgASgLMhEuc2luZXcudjEuTnVtYmVycxIqCg9qb2ludF9yb3RhdGlvbnMYBiABKAsyES5zaW5ldy52MS5OdW1iZXJzEi0KEnNlZ21lbnRfdHJhbnNmb3JtcxgHIAEoCzIRLnNpbmV3LnYxLk51bWJlcnMSIwoIdmVsb2NpdHkYCCABKAsyES5zaW5ldy52MS5OdW1iZXJzEicKDGFjY2VsZXJhdGlvbhgJIAEoCzIRLnNpbmV3LnYxLk51bWJlcnMSIQoGdG9ycXVlGAogASgLMhEuc2luZXcudjEuTnVtYmVycxIqCg9saWdhbWVudF90b3JxdWUYCyABKAsyES5zaW5ldy52MS5OdW1iZXJzEigKDXRvcnF1ZV9saW1pdHMYDCABKAsyES5zaW5ldy52MS5OdW1iZXJzEiQKCGNvbnRhY3RzGA0gASgLMhIuc2luZXcudjEuQ29udGFjdHMSIgoHYmFsYW5jZRgOIAEoCzIRLnNpbmV3LnYxLkJhbGFuY2USKQoHZGVzaXJlZBgPIAEoCzIYLnNpbmV3LnYxLkRlc2lyZWRQb3N0dXJlEiAKBnN0YXR1cxgQIAEoCzIQLnNpbmV3LnYxLlN0YXR1cxIeCgVhdWRpdBgRIAEoCzIPLnNpbmV3LnYxLkF1ZGl0EiQKCXBvc2l0aW9ucxgSIAEoCzIRLnNpbmV3LnYxLk51bWJlcnMSIgoHZmF0aWd1ZRgVIAEoCzIRLnNpbmV3LnYxLk51bWJlcnMSIQoGYXNzaXN0GBYgASgLMhEuc2luZXcudjEuTnVtYmVycxIiCgd0b3VjaGVzGBcgASgLMhEuc2luZXcudjEuVG91Y2hlcxIrChBjb25zdHJhaW50X2Vycm9yGBggASgLMhEuc2luZXcudjEuTnVtYmVycyKpAQoHVG91Y2hlcxIPCgdzZWdtZW50GAEgAygFEg0KBW90aGVyGAIgAygJEhUKDW90aGVyX3NlZ21lbnQYAyADKAUSIwoIcG9zaXRpb24YBCABKAsyES5zaW5ldy52MS5OdW1iZXJzEiAKBWZvcmNlGAUgASgLMhEuc2luZXcudjEuTnVtYmVycxIgCgVkZXB0aBgGIAEoCzIRLnNpbmV3LnYxLk51bWJlcnMicgoIQ29udGFjdHMSDwoHc2VnbWVudBgBIAMoBRIOCgZ2ZXJ0ZXgYAiADKAUSIwoIcG9zaXRpb24YAyABKAsyES5zaW5ldy52MS5OdW1iZXJzEiAKBWZvcmNlGAQgASgLMhEuc2luZXcudjEuTnVtYmVycyKiAgoHQmFsYW5jZRIeCgNjb20YASABKAsyES5zaW5ldy52MS5OdW1iZXJzEicKDGNvbV92ZWxvY2l0eRgCIAEoCzIRLnNpbmV3LnYxLk51bWJlcnMSJgoLY29tX2Rlc2lyZWQYAyABKAsyES5zaW5ldy52MS5OdW1iZXJzEh4KA3ptcBgEIAEoCzIRLnNpbmV3LnYxLk51bWJlcnMSFQoIbWFyZ2luX20YBSABKAFIAIgBARIiCgdwb2x5Z29uGAYgASgLMhEuc2luZXcudjEuTnVtYmVycxIUCgxtYWluX3N1cHBvcnQYByABKAUSKAoNc3VwcG9ydF9yYXRpbxgIIAEoCzIRLnNpbmV3LnYxLk51bWJlcnNCCwoJX21hcmdpbl9tIosBCg5EZXNpcmVkUG9zdHVyZRIkCglyb290X3Bvc2UYASABKAsyES5zaW5ldy52MS5OdW1iZXJzEicKDGpvaW50X2FuZ2xlcxgCIAEoCzIRLnNpbmV3LnYxLk51bWJlcnMSKgoPam9pbnRfcm90YXRpb25zGAMgASgLMhEuc2luZXcudjEuTnVtYmVycyLtAQoGU3RhdHVzEg0KBWZsYWdzGAEgASgFEhEKCXNhdHVyYXRlZBgCIAEoEBIbChNzYXR1cmF0ZWRfc2Vjb25kYXJ5GAMgASgQEhIKCm92ZXJfbGltaXQYBCABKAESHgoWdHJhY2tpbmdfam9pbnRfcm1zX3JhZBgFIAEoARIVCg1wZW5ldHJhdGlvbl9tGAYgASgBEhoKEmNvbnRyb2xfaXRlcmF0aW9ucxgHIAEoBRIXCg9zdGVwX2l0ZXJhdGlvbnMYCCABKAUSJAoFbG9hZHMYCSADKAsyFS5zaW5ldy52MS5DYXJyaWVkTG9hZCL5AgoFQXVkaXQSJAoJcG9zaXRpb25zGAEgASgLMhEuc2luZXcudjEuTnVtYmVycxIjCgh2ZWxvY2l0eRgCIAEoCzIRLnNpbmV3LnYxLk51bWJlcnMSJwoMYWNjZWxlcmF0aW9uGAMgASgLMhEuc2luZXcudjEuTnVtYmVycxIhCgZ0b3JxdWUYBCABKAsyES5zaW5ldy52MS5OdW1iZXJzEioKD2xpZ2FtZW50X3RvcnF1ZRgFIAEoCzIRLnNpbmV3LnYxLk51bWJlcnMSJAoIY29udGFjdHMYBiABKAsyEi5zaW5ldy52MS5Db250YWN0cxIoCgdhcHBsaWVkGAcgASgLMhcuc2luZXcudjEuQXBwbGllZEZvcmNlcxIkCgVsb2FkcxgIIAMoCzIVLnNpbmV3LnYxLkNhcnJpZWRMb2FkEhQKDGdyYXZpdHlfbXBzMhgJIAEoARIhCgZhc3Npc3QYDCABKAsyES5zaW5ldy52MS5OdW1iZXJzImcKDUFwcGxpZWRGb3JjZXMSDwoHc2VnbWVudBgBIAMoBRIjCghwb3NpdGlvbhgCIAEoCzIRLnNpbmV3LnYxLk51bWJlcnMSIAoFZm9yY2UYAyABKAsyES5zaW5ldy52MS5OdW1iZXJzYgZwcm90bzM",[Hs,on]);var so=Ie("ChRzaW5ldy92MS9zdGF0ZS5wcm90bxIIc2luZXcudjEimgEKBFZpZXcSGAoKZmlndXJlX2lkcxgBIAMoCUIE4kEBARIwCgZmaWVsZHMYAiABKAsyGi5nb29nbGUucHJvdG9idWYuRmllbGRNYXNrQgTiQQEBEioKCGVuY29kaW5nGAMgASgOMhIuc2luZXcudjEuRW5jb2RpbmdCBOJBAQESGgoMcmF0ZV9kaXZpc29yGAQgASgFQgTiQQEBInMKBlJvc3RlchIfCgV3b3JsZBgBIAEoCUIQ+kENCgtzaW5ldy9Xb3JsZBIPCgdyYXRlX2h6GAIgASgBEg8KB3ZlcnNpb24YAyABKAUSJgoHZmlndXJlcxgEIAMoCzIVLnNpbmV3LnYxLlJvc3RlckVudHJ5IlUKC1Jvc3RlckVudHJ5EhQKDGZpZ3VyZV9pbmRleBgBIAEoBRIRCglmaWd1cmVfaWQYAiABKAkSHQoEYm9keRgDIAEoCUIP+kEMCgpzaW5ldy9Cb2R5IoEBChRHZXRXb3JsZEZyYW1lUmVxdWVzdBIjCgV3b3JsZBgBIAEoCUIU4kEBAvpBDQoLc2luZXcvV29ybGQSFwoEdGljaxgCIAEoA0IE4kEBAUgAiAEBEiIKBHZpZXcYAyABKAsyDi5zaW5ldy52MS5WaWV3QgTiQQEBQgcKBV90aWNrIl4KFUdldFdvcmxkRnJhbWVSZXNwb25zZRIgCgZyb3N0ZXIYASABKAsyEC5zaW5ldy52MS5Sb3N0ZXISIwoFZnJhbWUYAiABKAsyFC5zaW5ldy52MS5Xb3JsZEZyYW1lIowBChFXYXRjaFdvcmxkUmVxdWVzdBIjCgV3b3JsZBgBIAEoCUIU4kEBAvpBDQoLc2luZXcvV29ybGQSIgoEdmlldxgCIAEoCzIOLnNpbmV3LnYxLlZpZXdCBOJBAQESHgoLcmVzdW1lX3RpY2sYAyABKANCBOJBAQFIAIgBAUIOCgxfcmVzdW1lX3RpY2siagoSV2F0Y2hXb3JsZFJlc3BvbnNlEiIKBnJvc3RlchgBIAEoCzIQLnNpbmV3LnYxLlJvc3RlckgAEiUKBWZyYW1lGAIgASgLMhQuc2luZXcudjEuV29ybGRGcmFtZUgAQgkKB21lc3NhZ2Ui4AEKBUV2ZW50EiEKBHR5cGUYASABKA4yEy5zaW5ldy52MS5FdmVudFR5cGUSDAoEdGljaxgCIAEoAxIOCgZ0aW1lX3MYAyABKAESEQoJZmlndXJlX2lkGAQgASgJEg8KB3NlZ21lbnQYBSABKAkSCwoDZG9mGAYgASgJEg8KB21hc3Nfa2cYByABKAESDgoGZGV0YWlsGAggASgJEg0KBW90aGVyGAkgASgJEhUKDW90aGVyX3NlZ21lbnQYCiABKAkSHgoWaW1wdWxzZV9uZXd0b25fc2Vjb25kcxgLIAEoASJ9ChJXYXRjaEV2ZW50c1JlcXVlc3QSIwoFd29ybGQYASABKAlCFOJBAQL6QQ0KC3NpbmV3L1dvcmxkEhgKCmZpZ3VyZV9pZHMYAiADKAlCBOJBAQESKAoFdHlwZXMYAyADKA4yEy5zaW5ldy52MS5FdmVudFR5cGVCBOJBAQEiTAoTV2F0Y2hFdmVudHNSZXNwb25zZRIfCgZldmVudHMYASADKAsyDy5zaW5ldy52MS5FdmVudBIUCgxtaXNzZWRfY291bnQYAiABKAMq8QcKCUV2ZW50VHlwZRIaChZFVkVOVF9UWVBFX1VOU1BFQ0lGSUVEEAASHQoZRVZFTlRfVFlQRV9TVVBQT1JUX0dBSU5FRBABEhsKF0VWRU5UX1RZUEVfU1VQUE9SVF9MT1NUEAISGAoURVZFTlRfVFlQRV9TQVRVUkFURUQQAxIXChNFVkVOVF9UWVBFX1JFTElFVkVEEAQSGwoXRVZFTlRfVFlQRV9CQUxBTkNFX0xPU1QQBRIYChRFVkVOVF9UWVBFX1JFQ09WRVJFRBAGEhMKD0VWRU5UX1RZUEVfRkVMTBAHEhkKFUVWRU5UX1RZUEVfTE9BRF9UQUtFThAIEhsKF0VWRU5UX1RZUEVfTE9BRF9EUk9QUEVEEAkSGwoXRVZFTlRfVFlQRV9MT0FEX1NMSVBQRUQQHhIVChFFVkVOVF9UWVBFX1BVU0hFRBAuEhoKFkVWRU5UX1RZUEVfUVVBUkFOVElORUQQChIbChdFVkVOVF9UWVBFX0ZJR1VSRV9BRERFRBALEh0KGUVWRU5UX1RZUEVfRklHVVJFX1JFTU9WRUQQDBIaChZFVkVOVF9UWVBFX0RSSVZFX0JFR0FOEA0SGgoWRVZFTlRfVFlQRV9EUklWRV9FTkRFRBAOEhkKFUVWRU5UX1RZUEVfQ0xJUF9CRUdBThATEhkKFUVWRU5UX1RZUEVfQ0xJUF9FTkRFRBAUEh0KGUVWRU5UX1RZUEVfRFJJVkVfUkVTWU5DRUQQIxIbChdFVkVOVF9UWVBFX1dPUkxEX1BBVVNFRBAPEhwKGEVWRU5UX1RZUEVfV09STERfUkVTVU1FRBAQEhsKF0VWRU5UX1RZUEVfV09STERfRkFJTEVEEBESHAoYRVZFTlRfVFlQRV9XT1JMRF9ERUxFVEVEEBUSFQoRRVZFTlRfVFlQRV9HT1RfVVAQEhIdChlFVkVOVF9UWVBFX1dPUkxEX1JFU1RPUkVEEC0SFgoSRVZFTlRfVFlQRV9UT1VDSEVEEB8SFQoRRVZFTlRfVFlQRV9QQVJURUQQIBIdChlFVkVOVF9UWVBFX09CU1RBQ0xFX0FEREVEECESHwobRVZFTlRfVFlQRV9PQlNUQUNMRV9SRU1PVkVEECISHwobRVZFTlRfVFlQRV9DT05UUk9MX0FDUVVJUkVEECgSHwobRVZFTlRfVFlQRV9DT05UUk9MX1JFTEVBU0VEECkSIAocRVZFTlRfVFlQRV9DT05UUk9MX1BSRUVNUFRFRBAqEh4KGkVWRU5UX1RZUEVfQ09OVFJPTF9PRkZFUkVEECsSHQoZRVZFTlRfVFlQRV9BQ0NFU1NfUkVGVVNFRBAsMosCCgxTdGF0ZVNlcnZpY2USVgoNR2V0V29ybGRGcmFtZRIeLnNpbmV3LnYxLkdldFdvcmxkRnJhbWVSZXF1ZXN0Gh8uc2luZXcudjEuR2V0V29ybGRGcmFtZVJlc3BvbnNlIgTo4BgBEk8KCldhdGNoV29ybGQSGy5zaW5ldy52MS5XYXRjaFdvcmxkUmVxdWVzdBocLnNpbmV3LnYxLldhdGNoV29ybGRSZXNwb25zZSIE6OAYATABElIKC1dhdGNoRXZlbnRzEhwuc2luZXcudjEuV2F0Y2hFdmVudHNSZXF1ZXN0Gh0uc2luZXcudjEuV2F0Y2hFdmVudHNSZXNwb25zZSIE6OAYATABYgZwcm90bzM",[nt,at,hi,Ys,lt,on]);var xg=ot(so,0);var FS=Ie("ChZzaW5ldy92MS9oaXN0b3J5LnByb3RvEghzaW5ldy52MSI3ChFHZXRIaXN0b3J5UmVxdWVzdBIiCgRuYW1lGAEgASgJQhTiQQEC+kENCgtzaW5ldy9Xb3JsZCJfChJHZXRIaXN0b3J5UmVzcG9uc2USEwoLb2xkZXN0X3RpY2sYASABKAMSEwoLbmV3ZXN0X3RpY2sYAiABKAMSHwoGZXZlbnRzGAMgAygLMg8uc2luZXcudjEuRXZlbnQitgEKElJlYWRIaXN0b3J5UmVxdWVzdBIiCgRuYW1lGAEgASgJQhTiQQEC+kENCgtzaW5ldy9Xb3JsZBIiCgR2aWV3GAIgASgLMg4uc2luZXcudjEuVmlld0IE4kEBARIdCgpmaXJzdF90aWNrGAMgASgDQgTiQQEBSACIAQESHAoJbGFzdF90aWNrGAQgASgDQgTiQQEBSAGIAQFCDQoLX2ZpcnN0X3RpY2tCDAoKX2xhc3RfdGljayJdChNSZWFkSGlzdG9yeVJlc3BvbnNlEiAKBnJvc3RlchgBIAEoCzIQLnNpbmV3LnYxLlJvc3RlchIkCgZmcmFtZXMYAiADKAsyFC5zaW5ldy52MS5Xb3JsZEZyYW1lImQKEFNlZWtXb3JsZFJlcXVlc3QSIgoEbmFtZRgBIAEoCUIU4kEBAvpBDQoLc2luZXcvV29ybGQSEgoEdGljaxgCIAEoA0IE4kEBAhIYCgpyZXF1ZXN0X2lkGA0gASgJQgTiQQEBIjMKEVNlZWtXb3JsZFJlc3BvbnNlEh4KBXdvcmxkGAEgASgLMg8uc2luZXcudjEuV29ybGQirgEKElJlcGxheVdvcmxkUmVxdWVzdBIiCgRuYW1lGAEgASgJQhTiQQEC+kENCgtzaW5ldy9Xb3JsZBIdCgpmaXJzdF90aWNrGAIgASgDQgTiQQEBSACIAQESHAoJbGFzdF90aWNrGAMgASgDQgTiQQEBSAGIAQESGgoMdGhyZWFkX2NvdW50GAQgASgFQgTiQQEBQg0KC19maXJzdF90aWNrQgwKCl9sYXN0X3RpY2siiQEKE1JlcGxheVdvcmxkUmVzcG9uc2USEgoKZmlyc3RfdGljaxgBIAEoAxIRCglsYXN0X3RpY2sYAiABKAMSGwoTY29tcGFyZWRfdGlja19jb3VudBgDIAEoAxIuCgpkaWZmZXJlbmNlGAQgASgLMhouc2luZXcudjEuUmVwbGF5RGlmZmVyZW5jZSJqChBSZXBsYXlEaWZmZXJlbmNlEgwKBHRpY2sYASABKAMSGwoTcmVjb3JkZWRfc3RhdGVfaGFzaBgCIAEoEBIbChNyZXBsYXllZF9zdGF0ZV9oYXNoGAMgASgQEg4KBmRldGFpbBgEIAEoCTLRAgoOSGlzdG9yeVNlcnZpY2USTQoKR2V0SGlzdG9yeRIbLnNpbmV3LnYxLkdldEhpc3RvcnlSZXF1ZXN0Ghwuc2luZXcudjEuR2V0SGlzdG9yeVJlc3BvbnNlIgTo4BgBElIKC1JlYWRIaXN0b3J5Ehwuc2luZXcudjEuUmVhZEhpc3RvcnlSZXF1ZXN0Gh0uc2luZXcudjEuUmVhZEhpc3RvcnlSZXNwb25zZSIE6OAYATABEkoKCVNlZWtXb3JsZBIaLnNpbmV3LnYxLlNlZWtXb3JsZFJlcXVlc3QaGy5zaW5ldy52MS5TZWVrV29ybGRSZXNwb25zZSIE6OAYBBJQCgtSZXBsYXlXb3JsZBIcLnNpbmV3LnYxLlJlcGxheVdvcmxkUmVxdWVzdBodLnNpbmV3LnYxLlJlcGxheVdvcmxkUmVzcG9uc2UiBOjgGARiBnByb3RvMw",[nt,at,Ys,lt,so,no]);var vg=ot(FS,0);var ro=Ie("ChVzaW5ldy92MS9tb3Rpb24ucHJvdG8SCHNpbmV3LnYxIvsCCgRDbGlwEhIKBG5hbWUYASABKAlCBOJBAQgSGgoMZGlzcGxheV9uYW1lGAIgASgJQgTiQQEDEhUKB2J1aWx0aW4YAyABKAhCBOJBAQMSIQoEYm9keRgEIAEoCUIT4kEBA/pBDAoKc2luZXcvQm9keRIVCgdyYXRlX2h6GAUgASgBQgTiQQEDEhkKC2ZyYW1lX2NvdW50GAYgASgFQgTiQQEDEhgKCmR1cmF0aW9uX3MYByABKAFCBOJBAQMSLgoGcmVwb3J0GAggASgLMhguc2luZXcudjEuUmV0YXJnZXRSZXBvcnRCBOJBAQMSNQoLY3JlYXRlX3RpbWUYCSABKAsyGi5nb29nbGUucHJvdG9idWYuVGltZXN0YW1wQgTiQQEDEioKCGZvcmVjYXN0GAogASgLMhIuc2luZXcudjEuRm9yZWNhc3RCBOJBAQM6KupBJwoKc2luZXcvQ2xpcBIMY2xpcHMve2NsaXB9KgVjbGlwczIEY2xpcCLLAwoIRm9yZWNhc3QSKgoHdmVyZGljdBgBIAEoDjIZLnNpbmV3LnYxLkZvcmVjYXN0VmVyZGljdBIOCgZyZWFzb24YAiABKAkSDgoGZGVtYW5kGAMgASgBEiEKGWxhY2tpbmdfZm9yY2Vfcm1zX3dlaWdodHMYBCABKAESIgoabGFja2luZ19mb3JjZV9wZWFrX3dlaWdodHMYBSABKAESIQoZbGFja2luZ19mb3JjZV9wZWFrX3RpbWVfcxgGIAEoARIkChxsYWNraW5nX21vbWVudF9wZWFrX3dlaWdodF9tGAcgASgBEh0KFWNhcHR1cmVfcG9pbnRfZHJpZnRfbRgIIAEoARIbChNzdHJlbmd0aF9wZWFrX3JhdGlvGAkgASgBEhQKDHN0cmVuZ3RoX2RvZhgKIAEoCRIcChRzdHJlbmd0aF9wZWFrX3RpbWVfcxgLIAEoARIaChJzdHJlbmd0aF9wOTVfcmF0aW8YDCABKAESEAoIZmxpZ2h0X3MYDSABKAESGAoQbG9uZ2VzdF9mbGlnaHRfcxgOIAEoARIXCg9mbG9vcl9jb250YWN0X3MYDyABKAESEgoKaW52ZXJ0ZWRfcxgQIAEoASKhAgoKQnZoT3B0aW9ucxIZCgZ1bml0X20YASABKAFCBOJBAQFIAIgBARIVCgd1cF9heGlzGAIgASgJQgTiQQEBEhoKB3JhdGVfaHoYAyABKAFCBOJBAQFIAYgBARIcCglmaXRfZmxvb3IYBCABKAhCBOJBAQFIAogBARIcCglsb2NrX2ZlZXQYBSABKAhCBOJBAQFIA4gBARIcCgljdXRvZmZfaHoYBiABKAFCBOJBAQFIBIgBARIcCgl3YWxrX3J1bnMYByABKAhCBOJBAQFIBYgBAUIJCgdfdW5pdF9tQgoKCF9yYXRlX2h6QgwKCl9maXRfZmxvb3JCDAoKX2xvY2tfZmVldEIMCgpfY3V0b2ZmX2h6QgwKCl93YWxrX3J1bnMiTAoJQnZoU291cmNlEhIKBGRhdGEYASABKAxCBOJBAQISKwoHb3B0aW9ucxgCIAEoCzIULnNpbmV3LnYxLkJ2aE9wdGlvbnNCBOJBAQEiUgoLRnJhbWVTb3VyY2USFQoHcmF0ZV9oehgBIAEoAUIE4kEBAhIsCgZmcmFtZXMYAiADKAsyFi5zaW5ldy52MS5GaWd1cmVNb3Rpb25CBOJBAQIi9wEKEUNyZWF0ZUNsaXBSZXF1ZXN0EhUKB2NsaXBfaWQYASABKAlCBOJBAQESGgoMZGlzcGxheV9uYW1lGAIgASgJQgTiQQEBEiEKBGJvZHkYAyABKAlCE+JBAQH6QQwKCnNpbmV3L0JvZHkSIgoDYnZoGAQgASgLMhMuc2luZXcudjEuQnZoU291cmNlSAASJwoGZnJhbWVzGAUgASgLMhUuc2luZXcudjEuRnJhbWVTb3VyY2VIABIYCgpyZXF1ZXN0X2lkGA0gASgJQgTiQQEBEhsKDXZhbGlkYXRlX29ubHkYDiABKAhCBOJBAQFCCAoGc291cmNlIjIKEkNyZWF0ZUNsaXBSZXNwb25zZRIcCgRjbGlwGAEgASgLMg4uc2luZXcudjEuQ2xpcCJRChdTdHJlYW1DcmVhdGVDbGlwUmVxdWVzdBI2CgtjcmVhdGVfY2xpcBgBIAEoCzIbLnNpbmV3LnYxLkNyZWF0ZUNsaXBSZXF1ZXN0QgTiQQECIm4KGFN0cmVhbUNyZWF0ZUNsaXBSZXNwb25zZRISCghwcm9ncmVzcxgBIAEoAUgAEjMKC2NyZWF0ZV9jbGlwGAIgASgLMhwuc2luZXcudjEuQ3JlYXRlQ2xpcFJlc3BvbnNlSABCCQoHbWVzc2FnZSIzCg5HZXRDbGlwUmVxdWVzdBIhCgRuYW1lGAEgASgJQhPiQQEC+kEMCgpzaW5ldy9DbGlwIi8KD0dldENsaXBSZXNwb25zZRIcCgRjbGlwGAEgASgLMg4uc2luZXcudjEuQ2xpcCJFChBMaXN0Q2xpcHNSZXF1ZXN0EhcKCXBhZ2Vfc2l6ZRgBIAEoBUIE4kEBARIYCgpwYWdlX3Rva2VuGAIgASgJQgTiQQEBIksKEUxpc3RDbGlwc1Jlc3BvbnNlEh0KBWNsaXBzGAEgAygLMg4uc2luZXcudjEuQ2xpcBIXCg9uZXh0X3BhZ2VfdG9rZW4YAiABKAkiUAoRRGVsZXRlQ2xpcFJlcXVlc3QSIQoEbmFtZRgBIAEoCUIT4kEBAvpBDAoKc2luZXcvQ2xpcBIYCgpyZXF1ZXN0X2lkGA0gASgJQgTiQQEBIhQKEkRlbGV0ZUNsaXBSZXNwb25zZSKwAgoPUGxheUNsaXBSZXF1ZXN0EiUKBmZpZ3VyZRgBIAEoCUIV4kEBAvpBDgoMc2luZXcvRmlndXJlEiEKBGNsaXAYAiABKAlCE+JBAQL6QQwKCnNpbmV3L0NsaXASEwoFc3BlZWQYAyABKAFCBOJBAQESEgoEbG9vcBgEIAEoCEIE4kEBARIfCgxzdGFydF90aW1lX3MYBSABKAFCBOJBAQFIAIgBARITCgVyZXNldBgGIAEoCEIE4kEBARIsCglwbGFjZW1lbnQYByABKAsyEy5zaW5ldy52MS5QbGFjZW1lbnRCBOJBAQESGAoKcmVxdWVzdF9pZBgNIAEoCUIE4kEBARIbCg1jb250cm9sX3Rva2VuGA8gASgJQgTiQQEBQg8KDV9zdGFydF90aW1lX3MiKAoQUGxheUNsaXBSZXNwb25zZRIUCgxzdGFydF90aW1lX3MYASABKAEibwoPU3RvcENsaXBSZXF1ZXN0EiUKBmZpZ3VyZRgBIAEoCUIV4kEBAvpBDgoMc2luZXcvRmlndXJlEhgKCnJlcXVlc3RfaWQYDSABKAlCBOJBAQESGwoNY29udHJvbF90b2tlbhgPIAEoCUIE4kEBASISChBTdG9wQ2xpcFJlc3BvbnNlIlAKDEJvbmVSb3RhdGlvbhISCgRib25lGAEgASgJQgTiQQECEiwKCHJvdGF0aW9uGAIgASgLMhQuc2luZXcudjEuUXVhdGVybmlvbkIE4kEBAiKHAgoMRmlndXJlTW90aW9uEhcKCWZpZ3VyZV9pZBgBIAEoCUIE4kEBARIiCgRyb290GAIgASgLMg4uc2luZXcudjEuUG9zZUIE4kEBARIeChBqb2ludF9hbmdsZXNfcmFkGAMgAygBQgTiQQEBEjQKDmJvbmVfcm90YXRpb25zGAQgAygLMhYuc2luZXcudjEuQm9uZVJvdGF0aW9uQgTiQQEBEjUKDnJvdGF0aW9uX3NwYWNlGAUgASgOMhcuc2luZXcudjEuUm90YXRpb25TcGFjZUIE4kEBARIWCgh2ZWxvY2l0eRgGIAMoAUIE4kEBARIVCgdwbGFudGVkGAcgAygIQgTiQQEBInIKC01vdGlvbkZyYW1lEhYKCHNlcXVlbmNlGAEgASgDQgTiQQEBEhwKDnNvdXJjZV90aW1lX25zGAIgASgQQgTiQQEBEi0KB2ZpZ3VyZXMYAyADKAsyFi5zaW5ldy52MS5GaWd1cmVNb3Rpb25CBOJBAQIiqQQKC0RyaXZlSGVhZGVyEiMKBXdvcmxkGAEgASgJQhTiQQEC+kENCgtzaW5ldy9Xb3JsZBIYCgpmaWd1cmVfaWRzGAIgAygJQgTiQQECEhcKCWRyaXZlcl9pZBgDIAEoCUIE4kEBARIdCg9ub21pbmFsX3JhdGVfaHoYBCABKAFCBOJBAQESIwoQcGxheW91dF9kZWxheV9tcxgFIAEoAUIE4kEBAUgAiAEBEiIKFG1heF9wbGF5b3V0X2RlbGF5X21zGAYgASgBQgTiQQEBEioKCHVuZGVycnVuGAcgASgOMhIuc2luZXcudjEuVW5kZXJydW5CBOJBAQESKQoWZXh0cmFwb2xhdGlvbl9saW1pdF9tcxgIIAEoAUIE4kEBAUgBiAEBEiAKDWhvbGRfbGltaXRfbXMYCSABKAFCBOJBAQFIAogBARIbCghncmFjZV9tcxgKIAEoAUIE4kEBAUgDiAEBEhMKBXJlc2V0GAsgASgIQgTiQQEBEigKFXByZXBhcmF0aW9uX3dpbmRvd19tcxgMIAEoAUIE4kEBAUgEiAEBEhwKDmNvbnRyb2xfdG9rZW5zGA8gAygJQgTiQQEBQhMKEV9wbGF5b3V0X2RlbGF5X21zQhkKF19leHRyYXBvbGF0aW9uX2xpbWl0X21zQhAKDl9ob2xkX2xpbWl0X21zQgsKCV9ncmFjZV9tc0IYChZfcHJlcGFyYXRpb25fd2luZG93X21zIjoKC01vdGlvbkJhdGNoEisKBmZyYW1lcxgBIAMoCzIVLnNpbmV3LnYxLk1vdGlvbkZyYW1lQgTiQQECInEKE0RyaXZlRmlndXJlc1JlcXVlc3QSJwoGaGVhZGVyGAEgASgLMhUuc2luZXcudjEuRHJpdmVIZWFkZXJIABImCgViYXRjaBgCIAEoCzIVLnNpbmV3LnYxLk1vdGlvbkJhdGNoSABCCQoHbWVzc2FnZSJBChREcml2ZUZpZ3VyZXNSZXNwb25zZRIpCghmZWVkYmFjaxgBIAEoCzIXLnNpbmV3LnYxLkRyaXZlRmVlZGJhY2sibAoRUHVzaE1vdGlvblJlcXVlc3QSKwoGaGVhZGVyGAEgASgLMhUuc2luZXcudjEuRHJpdmVIZWFkZXJCBOJBAQISKgoFYmF0Y2gYAiABKAsyFS5zaW5ldy52MS5Nb3Rpb25CYXRjaEIE4kEBAiI/ChJQdXNoTW90aW9uUmVzcG9uc2USKQoIZmVlZGJhY2sYASABKAsyFy5zaW5ldy52MS5Ecml2ZUZlZWRiYWNrIpMBCg1Ecml2ZUZlZWRiYWNrEhEKCWRyaXZlcl9pZBgBIAEoCRIMCgR0aWNrGAIgASgDEhkKEXJlY2VpdmVkX3NlcXVlbmNlGAMgASgDEhsKE3JlZnVzZWRfYmF0Y2hfY291bnQYBCABKAMSKQoHZmlndXJlcxgFIAMoCzIYLnNpbmV3LnYxLkZpZ3VyZUZlZWRiYWNrIsQDCg5GaWd1cmVGZWVkYmFjaxIRCglmaWd1cmVfaWQYASABKAkSGAoQYXBwbGllZF9zZXF1ZW5jZRgCIAEoAxIeChZhcHBsaWVkX3NvdXJjZV90aW1lX25zGAMgASgQEhMKC2J1ZmZlcmVkX21zGAQgASgBEhgKEHBsYXlvdXRfZGVsYXlfbXMYBSABKAESEQoJaml0dGVyX21zGAYgASgBEiAKBnN1cHBseRgHIAEoDjIQLnNpbmV3LnYxLlN1cHBseRIVCg1wcmVzZW50X2NvdW50GAggASgDEhoKEmludGVycG9sYXRlZF9jb3VudBgJIAEoAxIaChJleHRyYXBvbGF0ZWRfY291bnQYCiABKAMSEgoKaGVsZF9jb3VudBgLIAEoAxIVCg1yZWxheGVkX2NvdW50GAwgASgDEhIKCmxhdGVfY291bnQYDSABKAMSEwoLc3RhbGVfY291bnQYDiABKAMSFgoOb3ZlcmZsb3dfY291bnQYDyABKAMSHQoVcHJlcGFyYXRpb25fd2luZG93X21zGBAgASgBEhQKDHJlc3luY19jb3VudBgRIAEoAxIRCgliZWhpbmRfbXMYEiABKAEqjwEKD0ZvcmVjYXN0VmVyZGljdBIgChxGT1JFQ0FTVF9WRVJESUNUX1VOU1BFQ0lGSUVEEAASHAoYRk9SRUNBU1RfVkVSRElDVF9GT0xMT1dTEAESHwobRk9SRUNBU1RfVkVSRElDVF9ORUVEU19IRUxQEAISGwoXRk9SRUNBU1RfVkVSRElDVF9DQU5OT1QQAypkCg1Sb3RhdGlvblNwYWNlEh4KGlJPVEFUSU9OX1NQQUNFX1VOU1BFQ0lGSUVEEAASGQoVUk9UQVRJT05fU1BBQ0VfUEFSRU5UEAESGAoUUk9UQVRJT05fU1BBQ0VfV09STEQQAipRCghVbmRlcnJ1bhIYChRVTkRFUlJVTl9VTlNQRUNJRklFRBAAEhgKFFVOREVSUlVOX0VYVFJBUE9MQVRFEAESEQoNVU5ERVJSVU5fSE9MRBACKp8BCgZTdXBwbHkSFgoSU1VQUExZX1VOU1BFQ0lGSUVEEAASEgoOU1VQUExZX1BSRVNFTlQQARIXChNTVVBQTFlfSU5URVJQT0xBVEVEEAISFwoTU1VQUExZX0VYVFJBUE9MQVRFRBADEg8KC1NVUFBMWV9IRUxEEAQSEgoOU1VQUExZX1JFTEFYRUQQBRISCg5TVVBQTFlfV0FJVElORxAGMtwFCg1Nb3Rpb25TZXJ2aWNlEk0KCkNyZWF0ZUNsaXASGy5zaW5ldy52MS5DcmVhdGVDbGlwUmVxdWVzdBocLnNpbmV3LnYxLkNyZWF0ZUNsaXBSZXNwb25zZSIE6OAYBxJhChBTdHJlYW1DcmVhdGVDbGlwEiEuc2luZXcudjEuU3RyZWFtQ3JlYXRlQ2xpcFJlcXVlc3QaIi5zaW5ldy52MS5TdHJlYW1DcmVhdGVDbGlwUmVzcG9uc2UiBOjgGAcwARJECgdHZXRDbGlwEhguc2luZXcudjEuR2V0Q2xpcFJlcXVlc3QaGS5zaW5ldy52MS5HZXRDbGlwUmVzcG9uc2UiBOjgGAYSSgoJTGlzdENsaXBzEhouc2luZXcudjEuTGlzdENsaXBzUmVxdWVzdBobLnNpbmV3LnYxLkxpc3RDbGlwc1Jlc3BvbnNlIgTo4BgGEk0KCkRlbGV0ZUNsaXASGy5zaW5ldy52MS5EZWxldGVDbGlwUmVxdWVzdBocLnNpbmV3LnYxLkRlbGV0ZUNsaXBSZXNwb25zZSIE6OAYBxJHCghQbGF5Q2xpcBIZLnNpbmV3LnYxLlBsYXlDbGlwUmVxdWVzdBoaLnNpbmV3LnYxLlBsYXlDbGlwUmVzcG9uc2UiBOjgGAMSRwoIU3RvcENsaXASGS5zaW5ldy52MS5TdG9wQ2xpcFJlcXVlc3QaGi5zaW5ldy52MS5TdG9wQ2xpcFJlc3BvbnNlIgTo4BgDEk0KClB1c2hNb3Rpb24SGy5zaW5ldy52MS5QdXNoTW90aW9uUmVxdWVzdBocLnNpbmV3LnYxLlB1c2hNb3Rpb25SZXNwb25zZSIE6OAYAxJXCgxEcml2ZUZpZ3VyZXMSHS5zaW5ldy52MS5Ecml2ZUZpZ3VyZXNSZXF1ZXN0Gh4uc2luZXcudjEuRHJpdmVGaWd1cmVzUmVzcG9uc2UiBOjgGAMoATABYgZwcm90bzM",[nt,at,rn,lt,on]);var Sg=ot(ro,0);var US=Ie("ChdzaW5ldy92MS9vYnN0YWNsZS5wcm90bxIIc2luZXcudjEiJQoLU3BoZXJlU2hhcGUSFgoIcmFkaXVzX20YASABKAFCBOJBAQIiQwoMQ2Fwc3VsZVNoYXBlEhYKCHJhZGl1c19tGAEgASgBQgTiQQECEhsKDWhhbGZfbGVuZ3RoX20YAiABKAFCBOJBAQEiMwoIQm94U2hhcGUSJwoGaGFsZl9tGAEgASgLMhEuc2luZXcudjEuVmVjdG9yM0IE4kEBAiIMCgpQbGFuZVNoYXBlIqkECghPYnN0YWNsZRISCgRuYW1lGAEgASgJQgTiQQEIEicKBnNwaGVyZRgCIAEoCzIVLnNpbmV3LnYxLlNwaGVyZVNoYXBlSAASKQoHY2Fwc3VsZRgDIAEoCzIWLnNpbmV3LnYxLkNhcHN1bGVTaGFwZUgAEiEKA2JveBgEIAEoCzISLnNpbmV3LnYxLkJveFNoYXBlSAASJQoFcGxhbmUYBSABKAsyFC5zaW5ldy52MS5QbGFuZVNoYXBlSAASMgoIbW9iaWxpdHkYBiABKA4yGi5zaW5ldy52MS5PYnN0YWNsZU1vYmlsaXR5QgTiQQEBEhUKB21hc3Nfa2cYByABKAFCBOJBAQESGwoIZnJpY3Rpb24YCCABKAFCBOJBAQFIAYgBARIiCgRwb3NlGAkgASgLMg4uc2luZXcudjEuUG9zZUIE4kEBARItCgx2ZWxvY2l0eV9tcHMYCiABKAsyES5zaW5ldy52MS5WZWN0b3IzQgTiQQEBEjcKFmFuZ3VsYXJfdmVsb2NpdHlfcmFkX3MYCyABKAsyES5zaW5ldy52MS5WZWN0b3IzQgTiQQEBEhIKBGV0YWcYDCABKAlCBOJBAQE6TepBSgoOc2luZXcvT2JzdGFjbGUSI3dvcmxkcy97d29ybGR9L29ic3RhY2xlcy97b2JzdGFjbGV9KglvYnN0YWNsZXMyCG9ic3RhY2xlQgcKBXNoYXBlQgsKCV9mcmljdGlvbiK+AQoVQ3JlYXRlT2JzdGFjbGVSZXF1ZXN0EicKBnBhcmVudBgBIAEoCUIX4kEBAvpBEBIOc2luZXcvT2JzdGFjbGUSGQoLb2JzdGFjbGVfaWQYAiABKAlCBOJBAQESKgoIb2JzdGFjbGUYAyABKAsyEi5zaW5ldy52MS5PYnN0YWNsZUIE4kEBAhIYCgpyZXF1ZXN0X2lkGA0gASgJQgTiQQEBEhsKDXZhbGlkYXRlX29ubHkYDiABKAhCBOJBAQEiPgoWQ3JlYXRlT2JzdGFjbGVSZXNwb25zZRIkCghvYnN0YWNsZRgBIAEoCzISLnNpbmV3LnYxLk9ic3RhY2xlIjsKEkdldE9ic3RhY2xlUmVxdWVzdBIlCgRuYW1lGAEgASgJQhfiQQEC+kEQCg5zaW5ldy9PYnN0YWNsZSI7ChNHZXRPYnN0YWNsZVJlc3BvbnNlEiQKCG9ic3RhY2xlGAEgASgLMhIuc2luZXcudjEuT2JzdGFjbGUicgoUTGlzdE9ic3RhY2xlc1JlcXVlc3QSJwoGcGFyZW50GAEgASgJQhfiQQEC+kEQEg5zaW5ldy9PYnN0YWNsZRIXCglwYWdlX3NpemUYAiABKAVCBOJBAQESGAoKcGFnZV90b2tlbhgDIAEoCUIE4kEBASJXChVMaXN0T2JzdGFjbGVzUmVzcG9uc2USJQoJb2JzdGFjbGVzGAEgAygLMhIuc2luZXcudjEuT2JzdGFjbGUSFwoPbmV4dF9wYWdlX3Rva2VuGAIgASgJIpcBChVVcGRhdGVPYnN0YWNsZVJlcXVlc3QSKgoIb2JzdGFjbGUYASABKAsyEi5zaW5ldy52MS5PYnN0YWNsZUIE4kEBAhI1Cgt1cGRhdGVfbWFzaxgCIAEoCzIaLmdvb2dsZS5wcm90b2J1Zi5GaWVsZE1hc2tCBOJBAQESGwoNdmFsaWRhdGVfb25seRgOIAEoCEIE4kEBASI+ChZVcGRhdGVPYnN0YWNsZVJlc3BvbnNlEiQKCG9ic3RhY2xlGAEgASgLMhIuc2luZXcudjEuT2JzdGFjbGUibAoVRGVsZXRlT2JzdGFjbGVSZXF1ZXN0EiUKBG5hbWUYASABKAlCF+JBAQL6QRAKDnNpbmV3L09ic3RhY2xlEhIKBGV0YWcYDCABKAlCBOJBAQESGAoKcmVxdWVzdF9pZBgNIAEoCUIE4kEBASIYChZEZWxldGVPYnN0YWNsZVJlc3BvbnNlKokBChBPYnN0YWNsZU1vYmlsaXR5EiEKHU9CU1RBQ0xFX01PQklMSVRZX1VOU1BFQ0lGSUVEEAASGwoXT0JTVEFDTEVfTU9CSUxJVFlfRklYRUQQARIZChVPQlNUQUNMRV9NT0JJTElUWV9MRUQQAhIaChZPQlNUQUNMRV9NT0JJTElUWV9GUkVFEAMyzAMKD09ic3RhY2xlU2VydmljZRJZCg5DcmVhdGVPYnN0YWNsZRIfLnNpbmV3LnYxLkNyZWF0ZU9ic3RhY2xlUmVxdWVzdBogLnNpbmV3LnYxLkNyZWF0ZU9ic3RhY2xlUmVzcG9uc2UiBOjgGAQSUAoLR2V0T2JzdGFjbGUSHC5zaW5ldy52MS5HZXRPYnN0YWNsZVJlcXVlc3QaHS5zaW5ldy52MS5HZXRPYnN0YWNsZVJlc3BvbnNlIgTo4BgBElYKDUxpc3RPYnN0YWNsZXMSHi5zaW5ldy52MS5MaXN0T2JzdGFjbGVzUmVxdWVzdBofLnNpbmV3LnYxLkxpc3RPYnN0YWNsZXNSZXNwb25zZSIE6OAYARJZCg5VcGRhdGVPYnN0YWNsZRIfLnNpbmV3LnYxLlVwZGF0ZU9ic3RhY2xlUmVxdWVzdBogLnNpbmV3LnYxLlVwZGF0ZU9ic3RhY2xlUmVzcG9uc2UiBOjgGAQSWQoORGVsZXRlT2JzdGFjbGUSHy5zaW5ldy52MS5EZWxldGVPYnN0YWNsZVJlcXVlc3QaIC5zaW5ldy52MS5EZWxldGVPYnN0YWNsZVJlc3BvbnNlIgTo4BgEYgZwcm90bzM",[nt,at,hi,lt,on]);var _g=ot(US,0);var Eg=Ie("Chdnb29nbGUvcnBjL3N0YXR1cy5wcm90bxIKZ29vZ2xlLnJwYyJOCgZTdGF0dXMSDAoEY29kZRgBIAEoBRIPCgdtZXNzYWdlGAIgASgJEiUKB2RldGFpbHMYAyADKAsyFC5nb29nbGUucHJvdG9idWYuQW55QlsKDmNvbS5nb29nbGUucnBjQgtTdGF0dXNQcm90b1ABWjdnb29nbGUuZ29sYW5nLm9yZy9nZW5wcm90by9nb29nbGVhcGlzL3JwYy9zdGF0dXM7c3RhdHVz+AEBYgZwcm90bzM",[jr]);var Sd=Ie("ChtzaW5ldy92MS9wZXJ0dXJiYXRpb24ucHJvdG8SCHNpbmV3LnYxIpICCgRMb2FkEhUKB3NlZ21lbnQYASABKAlCBOJBAQISKAoHcG9pbnRfbRgCIAEoCzIRLnNpbmV3LnYxLlZlY3RvcjNCBOJBAQESFQoHbWFzc19rZxgDIAEoAUIE4kEBAhIYCgpkdXJhdGlvbl9zGAQgASgBQgTiQQEBEi0KDHZlbG9jaXR5X21wcxgFIAEoCzIRLnNpbmV3LnYxLlZlY3RvcjNCBOJBAQESHAoOc2Vjb25kX3NlZ21lbnQYBiABKAlCBOJBAQESLwoOc2Vjb25kX3BvaW50X20YByABKAsyES5zaW5ldy52MS5WZWN0b3IzQgTiQQEBEhoKDGdyaXBfbmV3dG9ucxgIIAEoAUIE4kEBASKdAQoHSW1wdWxzZRIVCgdzZWdtZW50GAEgASgJQgTiQQECEigKB3BvaW50X20YAiABKAsyES5zaW5ldy52MS5WZWN0b3IzQgTiQQEBEjcKFmltcHVsc2VfbmV3dG9uX3NlY29uZHMYAyABKAsyES5zaW5ldy52MS5WZWN0b3IzQgTiQQECEhgKCmR1cmF0aW9uX3MYBCABKAFCBOJBAQEikgEKBUZvcmNlEhUKB3NlZ21lbnQYASABKAlCBOJBAQISKAoHcG9pbnRfbRgCIAEoCzIRLnNpbmV3LnYxLlZlY3RvcjNCBOJBAQESLgoNZm9yY2VfbmV3dG9ucxgDIAEoCzIRLnNpbmV3LnYxLlZlY3RvcjNCBOJBAQISGAoKZHVyYXRpb25fcxgEIAEoAUIE4kEBASK5AQoMUGVydHVyYmF0aW9uEhcKCWZpZ3VyZV9pZBgBIAEoCUIE4kEBAhIXCgR0aWNrGAIgASgDQgTiQQEBSAGIAQESHgoEbG9hZBgDIAEoCzIOLnNpbmV3LnYxLkxvYWRIABIkCgdpbXB1bHNlGAQgASgLMhEuc2luZXcudjEuSW1wdWxzZUgAEiAKBWZvcmNlGAUgASgLMg8uc2luZXcudjEuRm9yY2VIAEIGCgRraW5kQgcKBV90aWNrIt0BChlBcHBseVBlcnR1cmJhdGlvbnNSZXF1ZXN0EiMKBXdvcmxkGAEgASgJQhTiQQEC+kENCgtzaW5ldy9Xb3JsZBIXCgljbGllbnRfaWQYAiABKAlCBOJBAQESFgoIc2VxdWVuY2UYAyABKANCBOJBAQESMwoNcGVydHVyYmF0aW9ucxgEIAMoCzIWLnNpbmV3LnYxLlBlcnR1cmJhdGlvbkIE4kEBAhIYCgpyZXF1ZXN0X2lkGA0gASgJQgTiQQEBEhsKDXZhbGlkYXRlX29ubHkYDiABKAhCBOJBAQEiKgoaQXBwbHlQZXJ0dXJiYXRpb25zUmVzcG9uc2USDAoEdGljaxgBIAEoAyJcChlDbGVhclBlcnR1cmJhdGlvbnNSZXF1ZXN0EiUKBmZpZ3VyZRgBIAEoCUIV4kEBAvpBDgoMc2luZXcvRmlndXJlEhgKCnJlcXVlc3RfaWQYDSABKAlCBOJBAQEiKgoaQ2xlYXJQZXJ0dXJiYXRpb25zUmVzcG9uc2USDAoEdGljaxgBIAEoAzLjAQoTUGVydHVyYmF0aW9uU2VydmljZRJlChJBcHBseVBlcnR1cmJhdGlvbnMSIy5zaW5ldy52MS5BcHBseVBlcnR1cmJhdGlvbnNSZXF1ZXN0GiQuc2luZXcudjEuQXBwbHlQZXJ0dXJiYXRpb25zUmVzcG9uc2UiBOjgGAISZQoSQ2xlYXJQZXJ0dXJiYXRpb25zEiMuc2luZXcudjEuQ2xlYXJQZXJ0dXJiYXRpb25zUmVxdWVzdBokLnNpbmV3LnYxLkNsZWFyUGVydHVyYmF0aW9uc1Jlc3BvbnNlIgTo4BgCYgZwcm90bzM",[nt,at,lt,on]);var Ag=ot(Sd,0);var _d=Ie("ChlzaW5ldy92MS9zaW11bGF0aW9uLnByb3RvEghzaW5ldy52MSJeChFUaW1lZFBlcnR1cmJhdGlvbhIVCgdzdGFydF9zGAEgASgBQgTiQQEBEjIKDHBlcnR1cmJhdGlvbhgCIAEoCzIWLnNpbmV3LnYxLlBlcnR1cmJhdGlvbkIE4kEBASLMAgoTU2ltdWxhdGVDbGlwUmVxdWVzdBIfCgRjbGlwGAEgASgJQg/6QQwKCnNpbmV3L0NsaXBIABIiCgNidmgYAiABKAsyEy5zaW5ldy52MS5CdmhTb3VyY2VIABImCgZmaWd1cmUYAyABKAsyEC5zaW5ldy52MS5GaWd1cmVCBOJBAQESFQoHcmF0ZV9oehgEIAEoAUIE4kEBARIbCg1zdWJzdGVwX2NvdW50GAUgASgFQgTiQQEBEhgKCmR1cmF0aW9uX3MYBiABKAFCBOJBAQESEgoEbG9vcBgHIAEoCEIE4kEBARI4Cg1wZXJ0dXJiYXRpb25zGAggAygLMhsuc2luZXcudjEuVGltZWRQZXJ0dXJiYXRpb25CBOJBAQESIgoEdmlldxgJIAEoCzIOLnNpbmV3LnYxLlZpZXdCBOJBAQFCCAoGc291cmNlIrUBChRTaW11bGF0ZUNsaXBSZXNwb25zZRIsCgdzdW1tYXJ5GAEgASgLMhsuc2luZXcudjEuU2ltdWxhdGlvblN1bW1hcnkSJAoGZnJhbWVzGAIgAygLMhQuc2luZXcudjEuV29ybGRGcmFtZRIfCgZldmVudHMYAyADKAsyDy5zaW5ldy52MS5FdmVudBIoCgZyZXBvcnQYBCABKAsyGC5zaW5ldy52MS5SZXRhcmdldFJlcG9ydCJXChlTdHJlYW1TaW11bGF0ZUNsaXBSZXF1ZXN0EjoKDXNpbXVsYXRlX2NsaXAYASABKAsyHS5zaW5ldy52MS5TaW11bGF0ZUNsaXBSZXF1ZXN0QgTiQQECIpIBChpTdHJlYW1TaW11bGF0ZUNsaXBSZXNwb25zZRIwCghwcm9ncmVzcxgBIAEoCzIcLnNpbmV3LnYxLlNpbXVsYXRpb25Qcm9ncmVzc0gAEjcKDXNpbXVsYXRlX2NsaXAYAiABKAsyHi5zaW5ldy52MS5TaW11bGF0ZUNsaXBSZXNwb25zZUgAQgkKB21lc3NhZ2UiTAoSU2ltdWxhdGlvblByb2dyZXNzEhAKCHByb2dyZXNzGAEgASgBEiQKBmZyYW1lcxgCIAMoCzIULnNpbmV3LnYxLldvcmxkRnJhbWUi6QIKEVNpbXVsYXRpb25TdW1tYXJ5EhIKCnRpY2tfY291bnQYASABKAUSDwoHcmF0ZV9oehgCIAEoARIWCglmZWxsX2F0X3MYAyABKAFIAIgBARIeChZ0cmFja2luZ19qb2ludF9ybXNfcmFkGAQgASgBEh4KFnRyYWNraW5nX2pvaW50X21heF9yYWQYBSABKAESFwoPbWF4X3V0aWxpc2F0aW9uGAYgASgBEhYKDm92ZXJfbGltaXRfbWF4GAcgASgBEhMKC3NhdHVyYXRlZF9zGAggAygBEhkKDG1hcmdpbl9taW5fbRgJIAEoAUgBiAEBEhkKEXBlbmV0cmF0aW9uX21heF9tGAogASgBEhIKCnN0YXRlX2hhc2gYCyABKBASEwoLdGlja19wNTBfdXMYDCABKAESEwoLdGlja19wOTlfdXMYDSABKAFCDAoKX2ZlbGxfYXRfc0IPCg1fbWFyZ2luX21pbl9tMtEBChFTaW11bGF0aW9uU2VydmljZRJTCgxTaW11bGF0ZUNsaXASHS5zaW5ldy52MS5TaW11bGF0ZUNsaXBSZXF1ZXN0Gh4uc2luZXcudjEuU2ltdWxhdGVDbGlwUmVzcG9uc2UiBOjgGAcSZwoSU3RyZWFtU2ltdWxhdGVDbGlwEiMuc2luZXcudjEuU3RyZWFtU2ltdWxhdGVDbGlwUmVxdWVzdBokLnNpbmV3LnYxLlN0cmVhbVNpbXVsYXRlQ2xpcFJlc3BvbnNlIgTo4BgHMAFiBnByb3RvMw",[nt,at,Hs,Ys,ro,lt,Sd,so,on]);var Mg=ot(_d,0);var PS=Ie("ChhzaW5ldy92MS9vcGVyYXRpb24ucHJvdG8SCHNpbmV3LnYxIuoDCglPcGVyYXRpb24SEgoEbmFtZRgBIAEoCUIE4kEBCBItCgVzdGF0ZRgCIAEoDjIYLnNpbmV3LnYxLk9wZXJhdGlvblN0YXRlQgTiQQEDEhYKCHByb2dyZXNzGAMgASgBQgTiQQEDEjUKC2NyZWF0ZV90aW1lGAQgASgLMhouZ29vZ2xlLnByb3RvYnVmLlRpbWVzdGFtcEIE4kEBAxIyCghlbmRfdGltZRgFIAEoCzIaLmdvb2dsZS5wcm90b2J1Zi5UaW1lc3RhbXBCBOJBAQMSNQoLZXhwaXJlX3RpbWUYBiABKAsyGi5nb29nbGUucHJvdG9idWYuVGltZXN0YW1wQgTiQQEDEiMKBWVycm9yGAcgASgLMhIuZ29vZ2xlLnJwYy5TdGF0dXNIABIzCgtjcmVhdGVfY2xpcBgIIAEoCzIcLnNpbmV3LnYxLkNyZWF0ZUNsaXBSZXNwb25zZUgAEjcKDXNpbXVsYXRlX2NsaXAYCSABKAsyHi5zaW5ldy52MS5TaW11bGF0ZUNsaXBSZXNwb25zZUgAOkPqQUAKD3NpbmV3L09wZXJhdGlvbhIWb3BlcmF0aW9ucy97b3BlcmF0aW9ufSoKb3BlcmF0aW9uczIJb3BlcmF0aW9uQggKBnJlc3VsdCKlAQoVU3RhcnRPcGVyYXRpb25SZXF1ZXN0EjIKC2NyZWF0ZV9jbGlwGAEgASgLMhsuc2luZXcudjEuQ3JlYXRlQ2xpcFJlcXVlc3RIABI2Cg1zaW11bGF0ZV9jbGlwGAIgASgLMh0uc2luZXcudjEuU2ltdWxhdGVDbGlwUmVxdWVzdEgAEhgKCnJlcXVlc3RfaWQYDSABKAlCBOJBAQFCBgoEd29yayJAChZTdGFydE9wZXJhdGlvblJlc3BvbnNlEiYKCW9wZXJhdGlvbhgBIAEoCzITLnNpbmV3LnYxLk9wZXJhdGlvbiI9ChNHZXRPcGVyYXRpb25SZXF1ZXN0EiYKBG5hbWUYASABKAlCGOJBAQL6QREKD3NpbmV3L09wZXJhdGlvbiI+ChRHZXRPcGVyYXRpb25SZXNwb25zZRImCglvcGVyYXRpb24YASABKAsyEy5zaW5ldy52MS5PcGVyYXRpb24iSgoVTGlzdE9wZXJhdGlvbnNSZXF1ZXN0EhcKCXBhZ2Vfc2l6ZRgBIAEoBUIE4kEBARIYCgpwYWdlX3Rva2VuGAIgASgJQgTiQQEBIloKFkxpc3RPcGVyYXRpb25zUmVzcG9uc2USJwoKb3BlcmF0aW9ucxgBIAMoCzITLnNpbmV3LnYxLk9wZXJhdGlvbhIXCg9uZXh0X3BhZ2VfdG9rZW4YAiABKAkicAoUV2FpdE9wZXJhdGlvblJlcXVlc3QSJgoEbmFtZRgBIAEoCUIY4kEBAvpBEQoPc2luZXcvT3BlcmF0aW9uEjAKB3RpbWVvdXQYAiABKAsyGS5nb29nbGUucHJvdG9idWYuRHVyYXRpb25CBOJBAQEiPwoVV2FpdE9wZXJhdGlvblJlc3BvbnNlEiYKCW9wZXJhdGlvbhgBIAEoCzITLnNpbmV3LnYxLk9wZXJhdGlvbiJAChZDYW5jZWxPcGVyYXRpb25SZXF1ZXN0EiYKBG5hbWUYASABKAlCGOJBAQL6QREKD3NpbmV3L09wZXJhdGlvbiJBChdDYW5jZWxPcGVyYXRpb25SZXNwb25zZRImCglvcGVyYXRpb24YASABKAsyEy5zaW5ldy52MS5PcGVyYXRpb24iQAoWRGVsZXRlT3BlcmF0aW9uUmVxdWVzdBImCgRuYW1lGAEgASgJQhjiQQEC+kERCg9zaW5ldy9PcGVyYXRpb24iGQoXRGVsZXRlT3BlcmF0aW9uUmVzcG9uc2UqxAEKDk9wZXJhdGlvblN0YXRlEh8KG09QRVJBVElPTl9TVEFURV9VTlNQRUNJRklFRBAAEhoKFk9QRVJBVElPTl9TVEFURV9RVUVVRUQQARIbChdPUEVSQVRJT05fU1RBVEVfUlVOTklORxACEh0KGU9QRVJBVElPTl9TVEFURV9TVUNDRUVERUQQAxIaChZPUEVSQVRJT05fU1RBVEVfRkFJTEVEEAQSHQoZT1BFUkFUSU9OX1NUQVRFX0NBTkNFTExFRBAFMrEEChBPcGVyYXRpb25TZXJ2aWNlElkKDlN0YXJ0T3BlcmF0aW9uEh8uc2luZXcudjEuU3RhcnRPcGVyYXRpb25SZXF1ZXN0GiAuc2luZXcudjEuU3RhcnRPcGVyYXRpb25SZXNwb25zZSIE6OAYBxJTCgxHZXRPcGVyYXRpb24SHS5zaW5ldy52MS5HZXRPcGVyYXRpb25SZXF1ZXN0Gh4uc2luZXcudjEuR2V0T3BlcmF0aW9uUmVzcG9uc2UiBOjgGAYSWQoOTGlzdE9wZXJhdGlvbnMSHy5zaW5ldy52MS5MaXN0T3BlcmF0aW9uc1JlcXVlc3QaIC5zaW5ldy52MS5MaXN0T3BlcmF0aW9uc1Jlc3BvbnNlIgTo4BgGElYKDVdhaXRPcGVyYXRpb24SHi5zaW5ldy52MS5XYWl0T3BlcmF0aW9uUmVxdWVzdBofLnNpbmV3LnYxLldhaXRPcGVyYXRpb25SZXNwb25zZSIE6OAYBhJcCg9DYW5jZWxPcGVyYXRpb24SIC5zaW5ldy52MS5DYW5jZWxPcGVyYXRpb25SZXF1ZXN0GiEuc2luZXcudjEuQ2FuY2VsT3BlcmF0aW9uUmVzcG9uc2UiBOjgGAYSXAoPRGVsZXRlT3BlcmF0aW9uEiAuc2luZXcudjEuRGVsZXRlT3BlcmF0aW9uUmVxdWVzdBohLnNpbmV3LnYxLkRlbGV0ZU9wZXJhdGlvblJlc3BvbnNlIgTo4BgGYgZwcm90bzM",[nt,at,La,rn,Eg,ro,lt,_d]);var Rg=ot(PS,0);var DS=Ie("ChhzaW5ldy92MS9yZWNvcmRpbmcucHJvdG8SCHNpbmV3LnYxIsACCglSZWNvcmRpbmcSEgoEbmFtZRgBIAEoCUIE4kEBCBItCgVzdGF0ZRgCIAEoDjIYLnNpbmV3LnYxLlJlY29yZGluZ1N0YXRlQgTiQQEDEhgKCmZpcnN0X3RpY2sYAyABKANCBOJBAQMSFwoJbGFzdF90aWNrGAQgASgDQgTiQQEDEhgKCnNpemVfYnl0ZXMYBSABKANCBOJBAQMSNQoLY3JlYXRlX3RpbWUYBiABKAsyGi5nb29nbGUucHJvdG9idWYuVGltZXN0YW1wQgTiQQEDEhgKCmVuZF9yZWFzb24YByABKAlCBOJBAQM6UupBTwoPc2luZXcvUmVjb3JkaW5nEiV3b3JsZHMve3dvcmxkfS9yZWNvcmRpbmdzL3tyZWNvcmRpbmd9KgpyZWNvcmRpbmdzMglyZWNvcmRpbmcipQEKFVN0YXJ0UmVjb3JkaW5nUmVxdWVzdBIoCgZwYXJlbnQYASABKAlCGOJBAQL6QRESD3NpbmV3L1JlY29yZGluZxIaCgxyZWNvcmRpbmdfaWQYAiABKAlCBOJBAQESHQoKZmlyc3RfdGljaxgDIAEoA0IE4kEBAUgAiAEBEhgKCnJlcXVlc3RfaWQYDSABKAlCBOJBAQFCDQoLX2ZpcnN0X3RpY2siQAoWU3RhcnRSZWNvcmRpbmdSZXNwb25zZRImCglyZWNvcmRpbmcYASABKAsyEy5zaW5ldy52MS5SZWNvcmRpbmciWAoUU3RvcFJlY29yZGluZ1JlcXVlc3QSJgoEbmFtZRgBIAEoCUIY4kEBAvpBEQoPc2luZXcvUmVjb3JkaW5nEhgKCnJlcXVlc3RfaWQYDSABKAlCBOJBAQEiPwoVU3RvcFJlY29yZGluZ1Jlc3BvbnNlEiYKCXJlY29yZGluZxgBIAEoCzITLnNpbmV3LnYxLlJlY29yZGluZyI9ChNHZXRSZWNvcmRpbmdSZXF1ZXN0EiYKBG5hbWUYASABKAlCGOJBAQL6QREKD3NpbmV3L1JlY29yZGluZyI+ChRHZXRSZWNvcmRpbmdSZXNwb25zZRImCglyZWNvcmRpbmcYASABKAsyEy5zaW5ldy52MS5SZWNvcmRpbmcidAoVTGlzdFJlY29yZGluZ3NSZXF1ZXN0EigKBnBhcmVudBgBIAEoCUIY4kEBAvpBERIPc2luZXcvUmVjb3JkaW5nEhcKCXBhZ2Vfc2l6ZRgCIAEoBUIE4kEBARIYCgpwYWdlX3Rva2VuGAMgASgJQgTiQQEBIloKFkxpc3RSZWNvcmRpbmdzUmVzcG9uc2USJwoKcmVjb3JkaW5ncxgBIAMoCzITLnNpbmV3LnYxLlJlY29yZGluZxIXCg9uZXh0X3BhZ2VfdG9rZW4YAiABKAkiWgoWRGVsZXRlUmVjb3JkaW5nUmVxdWVzdBImCgRuYW1lGAEgASgJQhjiQQEC+kERCg9zaW5ldy9SZWNvcmRpbmcSGAoKcmVxdWVzdF9pZBgNIAEoCUIE4kEBASIZChdEZWxldGVSZWNvcmRpbmdSZXNwb25zZSKKAQoWRXhwb3J0UmVjb3JkaW5nUmVxdWVzdBImCgRuYW1lGAEgASgJQhjiQQEC+kERCg9zaW5ldy9SZWNvcmRpbmcSLwoGZm9ybWF0GAIgASgOMhkuc2luZXcudjEuUmVjb3JkaW5nRm9ybWF0QgTiQQEBEhcKCWZpZ3VyZV9pZBgDIAEoCUIE4kEBASJAChdFeHBvcnRSZWNvcmRpbmdSZXNwb25zZRIMCgRkYXRhGAEgASgMEhcKD2RvbmVfdGlja19jb3VudBgCIAEoAyppCg5SZWNvcmRpbmdTdGF0ZRIfChtSRUNPUkRJTkdfU1RBVEVfVU5TUEVDSUZJRUQQABIbChdSRUNPUkRJTkdfU1RBVEVfUlVOTklORxABEhkKFVJFQ09SRElOR19TVEFURV9FTkRFRBACKoIBCg9SZWNvcmRpbmdGb3JtYXQSIAocUkVDT1JESU5HX0ZPUk1BVF9VTlNQRUNJRklFRBAAEhkKFVJFQ09SRElOR19GT1JNQVRfTUNBUBABEhgKFFJFQ09SRElOR19GT1JNQVRfQlZIEAISGAoUUkVDT1JESU5HX0ZPUk1BVF9DU1YQAzKzBAoQUmVjb3JkaW5nU2VydmljZRJZCg5TdGFydFJlY29yZGluZxIfLnNpbmV3LnYxLlN0YXJ0UmVjb3JkaW5nUmVxdWVzdBogLnNpbmV3LnYxLlN0YXJ0UmVjb3JkaW5nUmVzcG9uc2UiBOjgGAQSVgoNU3RvcFJlY29yZGluZxIeLnNpbmV3LnYxLlN0b3BSZWNvcmRpbmdSZXF1ZXN0Gh8uc2luZXcudjEuU3RvcFJlY29yZGluZ1Jlc3BvbnNlIgTo4BgEElMKDEdldFJlY29yZGluZxIdLnNpbmV3LnYxLkdldFJlY29yZGluZ1JlcXVlc3QaHi5zaW5ldy52MS5HZXRSZWNvcmRpbmdSZXNwb25zZSIE6OAYARJZCg5MaXN0UmVjb3JkaW5ncxIfLnNpbmV3LnYxLkxpc3RSZWNvcmRpbmdzUmVxdWVzdBogLnNpbmV3LnYxLkxpc3RSZWNvcmRpbmdzUmVzcG9uc2UiBOjgGAESXAoPRGVsZXRlUmVjb3JkaW5nEiAuc2luZXcudjEuRGVsZXRlUmVjb3JkaW5nUmVxdWVzdBohLnNpbmV3LnYxLkRlbGV0ZVJlY29yZGluZ1Jlc3BvbnNlIgTo4BgEEl4KD0V4cG9ydFJlY29yZGluZxIgLnNpbmV3LnYxLkV4cG9ydFJlY29yZGluZ1JlcXVlc3QaIS5zaW5ldy52MS5FeHBvcnRSZWNvcmRpbmdSZXNwb25zZSIE6OAYATABYgZwcm90bzM",[nt,at,rn,lt]);var wg=ot(DS,0);var GS=Ie("ChVzaW5ldy92MS9zZXJ2ZXIucHJvdG8SCHNpbmV3LnYxIhYKFEdldFNlcnZlckluZm9SZXF1ZXN0IrACChVHZXRTZXJ2ZXJJbmZvUmVzcG9uc2USDwoHdmVyc2lvbhgBIAEoCRIuCgpzdGFydF90aW1lGAIgASgLMhouZ29vZ2xlLnByb3RvYnVmLlRpbWVzdGFtcBISCgpmbGFnX25hbWVzGAMgAygJEhMKC3ZpZXdfZmllbGRzGAQgAygJEiYKDWJ1aWx0aW5fY2xpcHMYBSADKAlCD/pBDAoKc2luZXcvQ2xpcBIUCgxjYXBhYmlsaXRpZXMYBiADKAkSJQoGbGltaXRzGAcgAygLMhUuc2luZXcudjEuU2VydmVyTGltaXQSGQoRdGlja193b3JrZXJfY291bnQYCCABKAUSLQoNdGlja19wcmlvcml0eRgJIAEoDjIWLnNpbmV3LnYxLlRpY2tQcmlvcml0eSIqCgtTZXJ2ZXJMaW1pdBIMCgRuYW1lGAEgASgJEg0KBXZhbHVlGAIgASgDIjwKFUdldFNlcnZlclN0YXRzUmVxdWVzdBIjCgV3b3JsZBgBIAEoCUIU4kEBAfpBDQoLc2luZXcvV29ybGQiuwEKFkdldFNlcnZlclN0YXRzUmVzcG9uc2USJAoGd29ybGRzGAEgAygLMhQuc2luZXcudjEuV29ybGRTdGF0cxIaChJ3YXRjaF9zdHJlYW1fY291bnQYAiABKAUSGgoSZHJpdmVfc3RyZWFtX2NvdW50GAMgASgFEhgKEHNpbXVsYXRpb25fY291bnQYBCABKAUSEwoLYnVkZ2V0X3VzZWQYBSABKAESFAoMYnVkZ2V0X2xpbWl0GAYgASgBIvMBCgpXb3JsZFN0YXRzEh8KBXdvcmxkGAEgASgJQhD6QQ0KC3NpbmV3L1dvcmxkEhIKCnRpY2tfY291bnQYAiABKAMSFQoNb3ZlcnJ1bl9jb3VudBgDIAEoAxIVCg1za2lwcGVkX2NvdW50GAQgASgDEhUKDXJlZnVzZWRfY291bnQYBSABKAMSGwoTZHJvcHBlZF9mcmFtZV9jb3VudBgGIAEoAxIUCgx2aWV3ZXJfY291bnQYByABKAUSEwoLYnVkZ2V0X3VzZWQYCCABKAESIwoGc3RhZ2VzGAkgAygLMhMuc2luZXcudjEuU3RhZ2VUaW1lIkoKCVN0YWdlVGltZRINCgVzdGFnZRgBIAEoCRIOCgZwNTBfdXMYAiABKAESDgoGcDk5X3VzGAMgASgBEg4KBm1heF91cxgEIAEoASp2CgxUaWNrUHJpb3JpdHkSHQoZVElDS19QUklPUklUWV9VTlNQRUNJRklFRBAAEhYKElRJQ0tfUFJJT1JJVFlfRklGTxABEhYKElRJQ0tfUFJJT1JJVFlfTklDRRACEhcKE1RJQ0tfUFJJT1JJVFlfUExBSU4QAzLCAQoNU2VydmVyU2VydmljZRJWCg1HZXRTZXJ2ZXJJbmZvEh4uc2luZXcudjEuR2V0U2VydmVySW5mb1JlcXVlc3QaHy5zaW5ldy52MS5HZXRTZXJ2ZXJJbmZvUmVzcG9uc2UiBOjgGAYSWQoOR2V0U2VydmVyU3RhdHMSHy5zaW5ldy52MS5HZXRTZXJ2ZXJTdGF0c1JlcXVlc3QaIC5zaW5ldy52MS5HZXRTZXJ2ZXJTdGF0c1Jlc3BvbnNlIgTo4BgGYgZwcm90bzM",[nt,at,rn,lt]);var Tg=ot(GS,0);function VS(n){return e=>t=>(t.header.set("authorization",`Bearer ${n}`),e(t))}var OS=async(n,e)=>{let t=await fetch(n,e),i=e?.signal;if(!i||!t.body)return t;let s=t.body.getReader(),r=new ReadableStream({start(o){let a=()=>{o.error(i.reason),s.cancel(i.reason).catch(()=>{})};i.aborted?a():i.addEventListener("abort",a,{once:!0})},async pull(o){let{done:a,value:l}=await s.read();i.aborted||(a?o.close():o.enqueue(l))},cancel:o=>s.cancel(o)});return new Response(r,t)};function Ed(n,e=""){return xd({baseUrl:n,interceptors:e?[VS(e)]:[],...typeof document>"u"&&{fetch:OS}})}var el=class{access;bodies;checkpoints;control;figures;history;motion;obstacles;operations;perturbations;recordings;server;simulations;state;worlds;constructor(e,t=Ed(e)){this.access=$t(hg,t),this.bodies=$t(pg,t),this.checkpoints=$t(mg,t),this.control=$t(gg,t),this.figures=$t(bg,t),this.history=$t(vg,t),this.motion=$t(Sg,t),this.obstacles=$t(_g,t),this.operations=$t(Rg,t),this.perturbations=$t(Ag,t),this.recordings=$t(wg,t),this.server=$t(Tg,t),this.simulations=$t(Mg,t),this.state=$t(xg,t),this.worlds=$t(fg,t)}};function Tt(n){if(!n)return[];if(n.f32.length)return n.f32;if(n.f64.length)return n.f64;let e=new DataView(n.i16.buffer,n.i16.byteOffset,n.i16.byteLength);return Array.from({length:n.i16.byteLength>>1},(t,i)=>e.getInt16(2*i,!0)*n.scale)}function tl(n){return n instanceof Ve?[Ae.Unavailable,Ae.Unknown,Ae.Aborted,Ae.Internal,Ae.Canceled,Ae.DeadlineExceeded].includes(n.code):n instanceof TypeError}function Lt(n){return n instanceof Ve?n.rawMessage||Ae[n.code]:n instanceof Error?n.message:String(n)}function Cg(n){let e=new Map,t=new Vn(n);for(;t.pos<t.len;){let[i,s]=t.tag();if(s!==pt.LengthDelimited)t.skip(s,i);else{let r=t.bytes();e.has(i)||e.set(i,r)}}return e}function Ig(n){let e={};if(!(n instanceof Ve))return e;let t=i=>i&&new TextDecoder().decode(i);for(let i of n.details){if(!("type"in i))continue;let s=Cg(i.value);i.type==="google.rpc.ErrorInfo"&&(e.reason=t(s.get(1))),i.type==="google.rpc.BadRequest"&&(e.field=t(Cg(s.get(1)??new Uint8Array).get(1))),i.type==="google.rpc.ResourceInfo"&&(e.resource=t(s.get(2)))}return e}var Ng="\0push",Js=class{constructor(e){this.root=e}root;push;tags=new Map;update(e,t,i){let s=[...e],r=new Set(s.map(o=>o.name));for(let[o,a]of this.tags)o!==Ng&&!r.has(o)&&(a.remove(),this.tags.delete(o));for(let o of s){let a=o.name===t||s.length<=6&&!this.push;this.tag(o.name,o.name,o.name===t?"chosen":"",a?i?.label(o):void 0)}this.tag(Ng,this.push?.text??"","impulse",this.push&&{x:this.push.x,y:this.push.y-16})}tag(e,t,i,s){let r=this.tags.get(e);if(!s){r&&(r.hidden=!0);return}r||(r=document.createElement("span"),this.tags.set(e,r),this.root.append(r)),r.hidden=!1,r.textContent!==t&&(r.textContent=t),r.className!==i&&(r.className=i),r.style.transform=`translate(${s.x.toFixed(1)}px, ${s.y.toFixed(1)}px) translate(-50%, -100%)`}};function nl(n){let e=n.split("_"),t=e[0]==="l"?"left ":e[0]==="r"?"right ":"";return t+(t?e[1]:e[0])}function ti(n){let e=n.split("_"),t=e[0]==="l"?"left ":e[0]==="r"?"right ":"";return t+e.slice(t?1:0).join(" ")}function Fg(n){return`Forecast: ${n.verdict===1?"should be followed":n.verdict===2?"will need help":"cannot be followed"}: ${n.reason}`}function Ug(n){let{figureId:e}=n;switch(n.type){case 5:return{text:`${e} loses balance`,grave:!0};case 6:return{text:`${e} regains balance`,grave:!1};case 18:return{text:`${e} is back on its feet`,grave:!1};case 30:return{text:`${e} drops ${Zi(n.massKg)} from the ${nl(n.segment)}`,grave:!0};case 10:return{text:`${e} is frozen: its simulation state became invalid`,grave:!0};case 13:return{text:`${e} is now driven live${n.detail?` by ${n.detail}`:""}`,grave:!1};case 14:return{text:`Live control of ${e} has ended`,grave:!1};case 17:return{text:`The world has failed: ${n.detail}`,grave:!0};default:return}}function Ad(n){let{figureId:e}=n,t=n.detail.replace(/^clips\//,"");switch(n.type){case 5:return{kind:"fall",text:`${e} loses balance`};case 7:return{kind:"fall",text:`${e} falls`};case 10:return{kind:"fall",text:`${e} is frozen`};case 46:return{kind:"push",text:`${e} is pushed: ${n.impulseNewtonSeconds.toFixed(0)} N·s`};case 19:return{kind:"clip",text:`${e} begins “${t}”`};case 13:return{kind:"clip",text:`${e} is driven live`};case 8:return{kind:"mass",text:`${e} takes ${Zi(n.massKg)}`};case 9:return{kind:"mass",text:`${e} puts down ${Zi(n.massKg)}`};case 30:return{kind:"mass",text:`${e} drops ${Zi(n.massKg)}`};case 11:return{kind:"world",text:`${e} is added`};case 12:return{kind:"world",text:`${e} is removed`};case 33:case 34:return{kind:"world",text:`obstacle ${n.other} is ${n.type===33?"added":"removed"}`};case 45:return{kind:"world",text:"the world was rewound to this moment"};default:return}}function Pg(n){let e=n("QUARANTINED")?"frozen":n("FALLEN")?"fallen":n("BALANCE_LOST")?"off balance":n("FLIGHT")?"in the air":"standing";return n("HANDED_OVER")?`${e}, torque-driven for now`:e}function Dg(n){if(n===void 0||!Number.isFinite(n))return"no support";let e=Math.round(n*100)||0;return e<0?`${Math.abs(e)} cm outside support`:`${e} cm`}function Zi(n){return`${Number(n<1?n.toPrecision(2):n.toFixed(1))} kg`}function wi(n,e=0){let t=n.toFixed(e);return(Number(t)===0?t.replace("-",""):t).replace("-","−")}function WS(n,e){let i=e.reduce((s,r)=>s.replaceAll(new RegExp(`\\b${r}\\b`,"g"),ti(r)),n).replace(/\b[lr]_[a-z]+(?:_[a-z]+)*\b/g,ti);return i.charAt(0).toUpperCase()+i.slice(1)}var Bg=n=>`${(n*100).toFixed(1)} cm`;function Gg(n){return[`${n.mapped.length} bones matched`,`Performer ${n.statureM.toFixed(2)} m tall, ${n.upAxis} axis up, ${n.sourceRateHz.toFixed(0)} frames per second`,`Feet slide ${Bg(n.footSlideBeforeM)} in the recording, ${Bg(n.footSlideAfterM)} after preparation`]}function Md(n){let e=n.fraction<.01?"< 1":(n.fraction*100).toFixed(0),t=n.maxExcessRad*180/Math.PI;return[ti(n.dof),`${e} %`,t<1?"< 1°":`${t.toFixed(0)}°`]}function zS(n,e){let t=i=>i.toLowerCase().replace(/[^a-z]+/g," ");return n.includes(e)||` ${t(n)} `.includes(` ${t(ti(e))} `)}var Lg={excess:.087,share:.05};function Vg(n){let e=n.clamped.map(r=>r.dof),s=n.clamped.filter(r=>r.maxExcessRad>Lg.excess&&r.fraction>Lg.share).filter(r=>!n.warnings.some(o=>zS(o,r.dof))).map(r=>{let[,o,a]=Md(r);return`${r.dof} exceeds the body's limits by up to ${a} in ${o} of the frames`});return[...n.warnings,...s].map(r=>WS(r,e))}var Qs=class{constructor(e,t,i,s){this.slider=e;this.output=t;this.session=i;this.on=s;e.addEventListener("input",()=>this.changed())}slider;output;session;on;carrying;wanted;get mass(){return this.slider.valueAsNumber}enable(e){this.slider.disabled=!e}set(e){this.slider.disabled||(this.slider.valueAsNumber=e,this.changed())}changed(){this.on.change(),this.wanted=this.mass,this.show(this.wanted),this.carrying??=this.carry().finally(()=>this.carrying=void 0)}async carry(){try{for(;this.wanted!==void 0;){let e=this.wanted;this.wanted=void 0;let t=[...this.session.people.values()];for(let i of t)this.session.says(i,"FALLEN")&&await this.session.standUp(i);await this.session.carry(t,e),this.on.done()}}catch(e){this.on.failed(e)}}show(e){this.output.textContent=Zi(e),this.slider.setAttribute("aria-valuetext",`${e} kilograms in both hands of every figure`)}read(){if(this.carrying||document.activeElement===this.slider)return;let e=[...this.session.people.values()].filter(i=>i.frame).map(i=>i.loadKg());if(!e.length)return;let t=Math.max(...e);Math.abs(t-this.mass)>.01&&t<=20&&(this.slider.value=String(t)),this.show(t)}async none(){this.wanted=void 0,await this.carrying}gone(){this.slider.value="0",this.show(0)}};var At=7,XS=12,qs=8,Ks=class{constructor(e,t,i,s){this.index=e;this.name=t;this.body=i;this.figure=s;this.used=new Float32Array(i.dofs.length),this.limitSince=new Float64Array(i.dofs.length).fill(NaN)}index;name;body;figure;used;history=[];limitSince;frame;flags=0;take(e,t){this.frame=e;let i=Tt(e.torque),s=Tt(e.torqueLimits),r=this.body.dofs.length,o=e.status?.saturated??0n;if(this.flags=e.status?.flags??0,i.length!==r||s.length!==2*r)return;for(let l=0;l<r;l++){let c=i[l]<0?s[l]:s[r+l],u=c!==0?i[l]/c:0;this.used[l]=Math.min(1,Math.max(0,u)),(o>>BigInt(l)&1n)===1n?this.limitSince[l]<=t||(this.limitSince[l]=t):this.limitSince[l]=NaN}let a=this.history.at(-1);if(a&&t<a.time&&(this.history.length=0),!a||t>a.time)for(this.history.push({time:t,torque:Float32Array.from(i),limits:Float32Array.from(s)});this.history.length&&this.history[0].time<t-qs;)this.history.shift()}hardest(){let e=0;for(let t=1;t<this.used.length;t++)this.used[t]>this.used[e]&&(e=t);return e}loadKg(){return(this.frame?.status?.loads??[]).reduce((e,t)=>e+t.massKg,0)}get clip(){return this.figure.status?.clip||this.figure.status?.nextClip||""}holdsCrate(){let e=Tt(this.frame?.segmentTransforms);if(this.clip!=="clips/crate"||!e.length)return!1;let[t,i]=[this.segment("l_hand")*At,this.segment("r_hand")*At];return Math.hypot(e[t]-e[i],e[t+1]-e[i+1],e[t+2]-e[i+2])<.5}loads(){let e=(this.frame?.status?.loads??[]).map(s=>({massKg:s.massKg,segments:[this.body.segments[s.segment].name]})),[t,i]=["l_hand","r_hand"].map(s=>e.filter(r=>r.segments[0]===s));return!this.holdsCrate()||e.length!==2||t.length!==1||i.length!==1||Math.abs(t[0].massKg-i[0].massKg)>1e-9?e:[{massKg:t[0].massKg+i[0].massKg,segments:["l_hand","r_hand"]}]}segment(e){return this.body.segments.findIndex(t=>t.name===e)}},il=class{frames=[];time=NaN;lastNow=NaN;push(e){let t=this.frames.at(-1);t&&e.timeS<=t.timeS&&(this.frames.length=0),this.frames.push(e),this.frames.length>XS&&this.frames.shift()}newest(){return this.frames.at(-1)}clear(){this.frames.length=0,this.time=NaN}around(e){let t=this.frames.findIndex(o=>o.timeS>=e);if(t<0||t===0&&this.frames[0].timeS>e)return;let[i,s]=[this.frames[Math.max(0,t-1)],this.frames[t]],r=s.timeS-i.timeS;return{before:i,after:s,share:r>0?(e-i.timeS)/r:1}}at(e,t){let i=this.newest();if(!i)return;let s=this.frames[0],r=this.frames.length>1?(i.timeS-s.timeS)/(this.frames.length-1):1/60,o=i.timeS-1.6*r,a=Number.isNaN(this.lastNow)?0:Math.min(.25,e-this.lastNow);this.lastNow=e;let l=this.time+a*t,c=o-l;this.time=Number.isNaN(l)||Math.abs(c)>8*r+.1?o:l+.08*c,this.time=Math.min(Math.max(this.time,s.timeS),i.timeS);let u=this.frames.length-1;for(;u>0&&this.frames[u-1].timeS>=this.time;)u--;let h=this.frames[u],p=this.frames[Math.max(0,u-1)],d=h.timeS-p.timeS;return{before:p,after:h,share:d>0?(this.time-p.timeS)/d:1}}};function oo(n,e,t,i){let s=n.length===e.length?n:e;for(let r=0;r+At<=e.length;r+=At){let o=0;for(let c=3;c<At;c++)o+=s[r+c]*e[r+c];let a=o<0?-1:1,l=0;for(let c=0;c<At;c++){let u=s[r+c]*(1-t)*(c<3?1:a)+e[r+c]*t;i[r+c]=u,c>=3&&(l+=u*u)}l=Math.sqrt(l)||1;for(let c=3;c<At;c++)i[r+c]/=l}}function wd(n,e,t,i){for(let s=0;s<At;s++)i[s]=e[s];for(let s=1;s<n.segments.length;s++){let r=At*n.segments[s].parent,o=n.joints[s].offsetM,[a,l,c,u]=[i[r+3],i[r+4],i[r+5],i[r+6]],[h,p,d]=[o?.x??0,o?.y??0,o?.z??0],f=2*(l*d-c*p),b=2*(c*h-a*d),g=2*(a*p-l*h),m=At*s;i[m]=i[r]+h+u*f+l*g-c*b,i[m+1]=i[r+1]+p+u*b+c*f-a*g,i[m+2]=i[r+2]+d+u*g+a*b-l*f;let S=4*(s-1),[A,_,w,R]=[t[S],t[S+1],t[S+2],t[S+3]];i[m+3]=u*A+a*R+l*w-c*_,i[m+4]=u*_-a*w+l*R+c*A,i[m+5]=u*w+a*_-l*A+c*R,i[m+6]=u*R-a*A-l*_-c*w}}var Rd={from:.015,full:.08};function Og(n){let e=Math.min(1,Math.max(0,(n-Rd.from)/(Rd.full-Rd.from)));return e*e*(3-2*e)}function kg(n,e,t,i){let s=Math.hypot(n[t]-e[t],n[t+1]-e[t+1],n[t+2]-e[t+2]),r=0;for(let o=3;o<At;o++)r+=n[t+o]*e[t+o];return s+2*i*Math.sqrt(Math.max(0,1-r*r))}var ZS=250,Wg=new WeakMap;function Hi(n){let e=Wg.get(n);return e||(e=new Map(n.figures.map(t=>[t.figureIndex,t])),Wg.set(n,e)),e}var ao=n=>n.before.timeS+n.share*(n.after.timeS-n.before.timeS),js=class{constructor(e){this.session=e}session;all=new Map;bodies=new Map;roster;people=new Map;shown;asked=-1/0;past;version=-1;at(e,t){let{past:i}=this.session;i!==this.past&&(this.past=i,this.all.clear(),this.roster=this.shown=void 0),performance.now()-this.asked>ZS&&(this.asked=performance.now(),i?.lookAt(e));let s=this.session.playhead.around(e),r=this.session.roster,o=s&&r?{before:{frame:s.before,roster:r},after:{frame:s.after,roster:r},share:s.share,exact:!0}:i?.at(e);if(!o)return;let{before:a,after:l,share:c,exact:u}=o;this.cast(l.roster);let h={before:a.frame,after:l.frame,share:c,people:this.people,exact:u};return this.bring(l.frame,t),{...h,time:u?e:ao(h)}}cast(e){if(e===this.roster)return;let t=new Map,i=!0;for(let{figureIndex:s,figureId:r,body:o}of e.figures){let a=`${s} ${r} ${o}`,l=this.bodies.get(o);if(!l){i=!1,this.session.body(o).then(h=>this.bodies.set(o,h),()=>{});continue}let c=this.session.people.get(s),u=this.all.get(a)??new Ks(s,r,l,vt(yg));c?.name===r&&(u.figure=c.figure),this.all.set(a,u),t.set(s,u)}this.people=t,this.roster=i?e:void 0}bring(e,t){let i=this.past?.version??0,s=i!==this.version;if(this.version=i,e===this.shown&&!s)return;let r=this.shown?.timeS??NaN;this.shown=e;let o=!(e.timeS>=r&&e.timeS-r<.5);for(let a of this.people.values()){if(o&&a.limitSince.fill(NaN),(o||s)&&a.name===t){a.history.length=0;for(let c of this.session.past?.before(e.timeS,qs)??[]){let u=Hi(c.frame).get(a.index);u&&a.take(u,c.frame.timeS)}}let l=Hi(e).get(a.index);l&&a.take(l,e.timeS)}}};var ss={LEFT:0,MIDDLE:1,RIGHT:2,ROTATE:0,DOLLY:1,PAN:2},li={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},_y=0,oh=1,Ey=2;var Ms=1,Ay=2,Mr=3,rs=0,bn=1,xn=2,Rs=0,Rr=1,ah=2,lh=3,ch=4,My=5;var ws=100,Ry=101,wy=102,Ty=103,Cy=104,Iy=200,Ny=201,By=202,Ly=203,uh=204,dh=205,Fy=206,Uy=207,Py=208,Dy=209,Gy=210,Vy=211,Oy=212,ky=213,Wy=214,Cl=0,Il=1,Nl=2,pr=3,Bl=4,Ll=5,Fl=6,Ul=7,rc=0,zy=1,Xy=2,xi=0,hh=1,ph=2,fh=3,mh=4,gh=5,yh=6,Ho=7,qd="attached",Zy="detached",bh=300,Ts=301,wr=302,oc=303,ac=304,fr=1e3,fi=1001,Pl=1002,Jt=1003,Hy=1004;var Yo=1005;var gn=1006,lc=1007;var Gi=1008;var Mn=1009,xh=1010,vh=1011,Tr=1012,cc=1013,ci=1014,Zn=1015,ui=1016,uc=1017,dc=1018,Cs=1020,Sh=35902,_h=35899,Eh=1021,Ah=1022,Hn=1023,Fi=1026,Vi=1027,Mh=1028,hc=1029,os=1030,pc=1031;var fc=1033,Jo=33776,Qo=33777,Ko=33778,qo=33779,mc=35840,gc=35841,yc=35842,bc=35843,xc=36196,vc=37492,Sc=37496,_c=37488,Ec=37489,jo=37490,Ac=37491,Mc=37808,Rc=37809,wc=37810,Tc=37811,Cc=37812,Ic=37813,Nc=37814,Bc=37815,Lc=37816,Fc=37817,Uc=37818,Pc=37819,Dc=37820,Gc=37821,Vc=36492,Oc=36494,kc=36495,Wc=36283,zc=36284,$o=36285,Xc=36286;var bo=2300,Dl=2301,wl=2302,jd=2303,$d=2400,eh=2401,th=2402;var Yy=3200;var ea=0,Jy=1,Oi="",pn="srgb",xo="srgb-linear",vo="linear",ct="srgb";var Tl=7680;var Qy=519,Ky=512,qy=513,jy=514,Rh=515,$y=516,eb=517,wh=518,Th=519,tb=35044;var Ch="300 es",zn=2e3,mr=2001;function HS(n){for(let e=n.length-1;e>=0;--e)if(n[e]>=65535)return!0;return!1}function YS(n){return ArrayBuffer.isView(n)&&!(n instanceof DataView)}function So(n){return document.createElementNS("http://www.w3.org/1999/xhtml",n)}function nb(){let n=So("canvas");return n.style.display="block",n}var zg={},gr=null;function Ih(...n){let e="THREE."+n.shift();gr?gr("log",e,...n):console.log(e,...n)}function ib(n){let e=n[0];if(typeof e=="string"&&e.startsWith("TSL:")){let t=n[1];t&&t.isStackTrace?n[0]+=" "+t.getLocation():n[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return n}function Ne(...n){n=ib(n);let e="THREE."+n.shift();if(gr)gr("warn",e,...n);else{let t=n[0];t&&t.isStackTrace?console.warn(t.getError(e)):console.warn(e,...n)}}function Pe(...n){n=ib(n);let e="THREE."+n.shift();if(gr)gr("error",e,...n);else{let t=n[0];t&&t.isStackTrace?console.error(t.getError(e)):console.error(e,...n)}}function mo(...n){let e=n.join(" ");e in zg||(zg[e]=!0,Ne(...n))}function sb(n,e,t){return new Promise(function(i,s){function r(){switch(n.clientWaitSync(e,n.SYNC_FLUSH_COMMANDS_BIT,0)){case n.WAIT_FAILED:s();break;case n.TIMEOUT_EXPIRED:setTimeout(r,t);break;default:i()}}setTimeout(r,t)})}var rb={[Cl]:Cl,[Nl]:Fl,[Bl]:Bl,[pr]:Ll,[Il]:Il,[Fl]:Nl,[Ul]:Ul,[Ll]:pr},ri=class{addEventListener(e,t){this._listeners===void 0&&(this._listeners={});let i=this._listeners;i[e]===void 0&&(i[e]=[]),i[e].indexOf(t)===-1&&i[e].push(t)}hasEventListener(e,t){let i=this._listeners;return i===void 0?!1:i[e]!==void 0&&i[e].indexOf(t)!==-1}removeEventListener(e,t){let i=this._listeners;if(i===void 0)return;let s=i[e];if(s!==void 0){let r=s.indexOf(t);r!==-1&&s.splice(r,1)}}dispatchEvent(e){let t=this._listeners;if(t===void 0)return;let i=t[e.type];if(i!==void 0){e.target=this;let s=i.slice(0);for(let r=0,o=s.length;r<o;r++)s[r].call(this,e);e.target=null}}},an=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],Xg=1234567,go=Math.PI/180,yr=180/Math.PI;function Is(){let n=Math.random()*4294967295|0,e=Math.random()*4294967295|0,t=Math.random()*4294967295|0,i=Math.random()*4294967295|0;return(an[n&255]+an[n>>8&255]+an[n>>16&255]+an[n>>24&255]+"-"+an[e&255]+an[e>>8&255]+"-"+an[e>>16&15|64]+an[e>>24&255]+"-"+an[t&63|128]+an[t>>8&255]+"-"+an[t>>16&255]+an[t>>24&255]+an[i&255]+an[i>>8&255]+an[i>>16&255]+an[i>>24&255]).toLowerCase()}function Je(n,e,t){return Math.max(e,Math.min(t,n))}function Nh(n,e){return(n%e+e)%e}function JS(n,e,t,i,s){return i+(n-e)*(s-i)/(t-e)}function QS(n,e,t){return n!==e?(t-n)/(e-n):0}function yo(n,e,t){return(1-t)*n+t*e}function KS(n,e,t,i){return yo(n,e,1-Math.exp(-t*i))}function qS(n,e=1){return e-Math.abs(Nh(n,e*2)-e)}function jS(n,e,t){return n<=e?0:n>=t?1:(n=(n-e)/(t-e),n*n*(3-2*n))}function $S(n,e,t){return n<=e?0:n>=t?1:(n=(n-e)/(t-e),n*n*n*(n*(n*6-15)+10))}function e_(n,e){return n+Math.floor(Math.random()*(e-n+1))}function t_(n,e){return n+Math.random()*(e-n)}function n_(n){return n*(.5-Math.random())}function i_(n){n!==void 0&&(Xg=n);let e=Xg+=1831565813;return e=Math.imul(e^e>>>15,e|1),e^=e+Math.imul(e^e>>>7,e|61),((e^e>>>14)>>>0)/4294967296}function s_(n){return n*go}function r_(n){return n*yr}function o_(n){return n>0&&Number.isInteger(n)&&2**Math.round(Math.log2(n))===n}function a_(n){return Math.pow(2,Math.ceil(Math.log(n)/Math.LN2))}function Bh(n){return Math.pow(2,Math.floor(Math.log(n)/Math.LN2))}function l_(n,e,t,i,s){let r=Math.cos,o=Math.sin,a=r(t/2),l=o(t/2),c=r((e+i)/2),u=o((e+i)/2),h=r((e-i)/2),p=o((e-i)/2),d=r((i-e)/2),f=o((i-e)/2);switch(s){case"XYX":n.set(a*u,l*h,l*p,a*c);break;case"YZY":n.set(l*p,a*u,l*h,a*c);break;case"ZXZ":n.set(l*h,l*p,a*u,a*c);break;case"XZX":n.set(a*u,l*f,l*d,a*c);break;case"YXY":n.set(l*d,a*u,l*f,a*c);break;case"ZYZ":n.set(l*f,l*d,a*u,a*c);break;default:Ne("MathUtils: .setQuaternionFromProperEuler() encountered an unknown order: "+s)}}function Lh(n){switch(n.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function ob(n,e){if(e.constructor===Float32Array)return n;let t=Lh(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(n/t,-1)}function ab(n,e){if(e.constructor===Float32Array)return n;let t=Lh(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(n*t)}var ki={DEG2RAD:go,RAD2DEG:yr,generateUUID:Is,clamp:Je,euclideanModulo:Nh,mapLinear:JS,inverseLerp:QS,lerp:yo,damp:KS,pingpong:qS,smoothstep:jS,smootherstep:$S,randInt:e_,randFloat:t_,randFloatSpread:n_,seededRandom:i_,degToRad:s_,radToDeg:r_,isPowerOfTwo:o_,ceilPowerOfTwo:a_,floorPowerOfTwo:Bh,setQuaternionFromProperEuler:l_,normalize:ab,denormalize:ob},Be=class{static{this.prototype.isVector2=!0}constructor(e=0,t=0){this.x=e,this.y=t}get width(){return this.x}set width(e){this.x=e}get height(){return this.y}set height(e){this.y=e}set(e,t){return this.x=e,this.y=t,this}setScalar(e){return this.x=e,this.y=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;default:throw new Error("THREE.Vector2: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y)}copy(e){return this.x=e.x,this.y=e.y,this}add(e){return this.x+=e.x,this.y+=e.y,this}addScalar(e){return this.x+=e,this.y+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this}subScalar(e){return this.x-=e,this.y-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this}multiply(e){return this.x*=e.x,this.y*=e.y,this}multiplyScalar(e){return this.x*=e,this.y*=e,this}divide(e){return this.x/=e.x,this.y/=e.y,this}divideScalar(e){return this.multiplyScalar(1/e)}applyMatrix3(e){let t=this.x,i=this.y,s=e.elements;return this.x=s[0]*t+s[3]*i+s[6],this.y=s[1]*t+s[4]*i+s[7],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this}clamp(e,t){return this.x=Je(this.x,e.x,t.x),this.y=Je(this.y,e.y,t.y),this}clampScalar(e,t){return this.x=Je(this.x,e,t),this.y=Je(this.y,e,t),this}clampLength(e,t){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Je(i,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(e){return this.x*e.x+this.y*e.y}cross(e){return this.x*e.y-this.y*e.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let i=this.dot(e)/t;return Math.acos(Je(i,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,i=this.y-e.y;return t*t+i*i}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this}lerpVectors(e,t,i){return this.x=e.x+(t.x-e.x)*i,this.y=e.y+(t.y-e.y)*i,this}equals(e){return e.x===this.x&&e.y===this.y}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this}rotateAround(e,t){let i=Math.cos(t),s=Math.sin(t),r=this.x-e.x,o=this.y-e.y;return this.x=r*i-o*s+e.x,this.y=r*s+o*i+e.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},en=class{constructor(e=0,t=0,i=0,s=1){this.isQuaternion=!0,this._x=e,this._y=t,this._z=i,this._w=s}static slerpFlat(e,t,i,s,r,o,a){let l=i[s+0],c=i[s+1],u=i[s+2],h=i[s+3],p=r[o+0],d=r[o+1],f=r[o+2],b=r[o+3];if(h!==b||l!==p||c!==d||u!==f){let g=l*p+c*d+u*f+h*b;g<0&&(p=-p,d=-d,f=-f,b=-b,g=-g);let m=1-a;if(g<.9995){let S=Math.acos(g),A=Math.sin(S);m=Math.sin(m*S)/A,a=Math.sin(a*S)/A,l=l*m+p*a,c=c*m+d*a,u=u*m+f*a,h=h*m+b*a}else{l=l*m+p*a,c=c*m+d*a,u=u*m+f*a,h=h*m+b*a;let S=1/Math.sqrt(l*l+c*c+u*u+h*h);l*=S,c*=S,u*=S,h*=S}}e[t]=l,e[t+1]=c,e[t+2]=u,e[t+3]=h}static multiplyQuaternionsFlat(e,t,i,s,r,o){let a=i[s],l=i[s+1],c=i[s+2],u=i[s+3],h=r[o],p=r[o+1],d=r[o+2],f=r[o+3];return e[t]=a*f+u*h+l*d-c*p,e[t+1]=l*f+u*p+c*h-a*d,e[t+2]=c*f+u*d+a*p-l*h,e[t+3]=u*f-a*h-l*p-c*d,e}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get w(){return this._w}set w(e){this._w=e,this._onChangeCallback()}set(e,t,i,s){return this._x=e,this._y=t,this._z=i,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(e){return this._x=e.x,this._y=e.y,this._z=e.z,this._w=e.w,this._onChangeCallback(),this}setFromEuler(e,t=!0){let i=e._x,s=e._y,r=e._z,o=e._order,a=Math.cos,l=Math.sin,c=a(i/2),u=a(s/2),h=a(r/2),p=l(i/2),d=l(s/2),f=l(r/2);switch(o){case"XYZ":this._x=p*u*h+c*d*f,this._y=c*d*h-p*u*f,this._z=c*u*f+p*d*h,this._w=c*u*h-p*d*f;break;case"YXZ":this._x=p*u*h+c*d*f,this._y=c*d*h-p*u*f,this._z=c*u*f-p*d*h,this._w=c*u*h+p*d*f;break;case"ZXY":this._x=p*u*h-c*d*f,this._y=c*d*h+p*u*f,this._z=c*u*f+p*d*h,this._w=c*u*h-p*d*f;break;case"ZYX":this._x=p*u*h-c*d*f,this._y=c*d*h+p*u*f,this._z=c*u*f-p*d*h,this._w=c*u*h+p*d*f;break;case"YZX":this._x=p*u*h+c*d*f,this._y=c*d*h+p*u*f,this._z=c*u*f-p*d*h,this._w=c*u*h-p*d*f;break;case"XZY":this._x=p*u*h-c*d*f,this._y=c*d*h-p*u*f,this._z=c*u*f+p*d*h,this._w=c*u*h+p*d*f;break;default:Ne("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return t===!0&&this._onChangeCallback(),this}setFromAxisAngle(e,t){let i=t/2,s=Math.sin(i);return this._x=e.x*s,this._y=e.y*s,this._z=e.z*s,this._w=Math.cos(i),this._onChangeCallback(),this}setFromRotationMatrix(e){let t=e.elements,i=t[0],s=t[4],r=t[8],o=t[1],a=t[5],l=t[9],c=t[2],u=t[6],h=t[10],p=i+a+h;if(p>0){let d=.5/Math.sqrt(p+1);this._w=.25/d,this._x=(u-l)*d,this._y=(r-c)*d,this._z=(o-s)*d}else if(i>a&&i>h){let d=2*Math.sqrt(1+i-a-h);this._w=(u-l)/d,this._x=.25*d,this._y=(s+o)/d,this._z=(r+c)/d}else if(a>h){let d=2*Math.sqrt(1+a-i-h);this._w=(r-c)/d,this._x=(s+o)/d,this._y=.25*d,this._z=(l+u)/d}else{let d=2*Math.sqrt(1+h-i-a);this._w=(o-s)/d,this._x=(r+c)/d,this._y=(l+u)/d,this._z=.25*d}return this._onChangeCallback(),this}setFromUnitVectors(e,t){let i=e.dot(t)+1;return i<1e-8?(i=0,Math.abs(e.x)>Math.abs(e.z)?(this._x=-e.y,this._y=e.x,this._z=0,this._w=i):(this._x=0,this._y=-e.z,this._z=e.y,this._w=i)):(this._x=e.y*t.z-e.z*t.y,this._y=e.z*t.x-e.x*t.z,this._z=e.x*t.y-e.y*t.x,this._w=i),this.normalize()}angleTo(e){return 2*Math.acos(Math.abs(Je(this.dot(e),-1,1)))}rotateTowards(e,t){let i=this.angleTo(e);if(i===0)return this;let s=Math.min(1,t/i);return this.slerp(e,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(e){return this._x*e._x+this._y*e._y+this._z*e._z+this._w*e._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let e=this.length();return e===0?(this._x=0,this._y=0,this._z=0,this._w=1):(e=1/e,this._x=this._x*e,this._y=this._y*e,this._z=this._z*e,this._w=this._w*e),this._onChangeCallback(),this}multiply(e){return this.multiplyQuaternions(this,e)}premultiply(e){return this.multiplyQuaternions(e,this)}multiplyQuaternions(e,t){let i=e._x,s=e._y,r=e._z,o=e._w,a=t._x,l=t._y,c=t._z,u=t._w;return this._x=i*u+o*a+s*c-r*l,this._y=s*u+o*l+r*a-i*c,this._z=r*u+o*c+i*l-s*a,this._w=o*u-i*a-s*l-r*c,this._onChangeCallback(),this}slerp(e,t){let i=e._x,s=e._y,r=e._z,o=e._w,a=this.dot(e);a<0&&(i=-i,s=-s,r=-r,o=-o,a=-a);let l=1-t;if(a<.9995){let c=Math.acos(a),u=Math.sin(c);l=Math.sin(l*c)/u,t=Math.sin(t*c)/u,this._x=this._x*l+i*t,this._y=this._y*l+s*t,this._z=this._z*l+r*t,this._w=this._w*l+o*t,this._onChangeCallback()}else this._x=this._x*l+i*t,this._y=this._y*l+s*t,this._z=this._z*l+r*t,this._w=this._w*l+o*t,this.normalize();return this}slerpQuaternions(e,t,i){return this.copy(e).slerp(t,i)}random(){let e=2*Math.PI*Math.random(),t=2*Math.PI*Math.random(),i=Math.random(),s=Math.sqrt(1-i),r=Math.sqrt(i);return this.set(s*Math.sin(e),s*Math.cos(e),r*Math.sin(t),r*Math.cos(t))}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._w===this._w}fromArray(e,t=0){return this._x=e[t],this._y=e[t+1],this._z=e[t+2],this._w=e[t+3],this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._w,e}fromBufferAttribute(e,t){return this._x=e.getX(t),this._y=e.getY(t),this._z=e.getZ(t),this._w=e.getW(t),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},F=class{static{this.prototype.isVector3=!0}constructor(e=0,t=0,i=0){this.x=e,this.y=t,this.z=i}set(e,t,i){return i===void 0&&(i=this.z),this.x=e,this.y=t,this.z=i,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;default:throw new Error("THREE.Vector3: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this}multiplyVectors(e,t){return this.x=e.x*t.x,this.y=e.y*t.y,this.z=e.z*t.z,this}applyEuler(e){return this.applyQuaternion(Zg.setFromEuler(e))}applyAxisAngle(e,t){return this.applyQuaternion(Zg.setFromAxisAngle(e,t))}applyMatrix3(e){let t=this.x,i=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[3]*i+r[6]*s,this.y=r[1]*t+r[4]*i+r[7]*s,this.z=r[2]*t+r[5]*i+r[8]*s,this}applyNormalMatrix(e){return this.applyMatrix3(e).normalize()}applyMatrix4(e){let t=this.x,i=this.y,s=this.z,r=e.elements,o=1/(r[3]*t+r[7]*i+r[11]*s+r[15]);return this.x=(r[0]*t+r[4]*i+r[8]*s+r[12])*o,this.y=(r[1]*t+r[5]*i+r[9]*s+r[13])*o,this.z=(r[2]*t+r[6]*i+r[10]*s+r[14])*o,this}applyQuaternion(e){let t=this.x,i=this.y,s=this.z,r=e.x,o=e.y,a=e.z,l=e.w,c=2*(o*s-a*i),u=2*(a*t-r*s),h=2*(r*i-o*t);return this.x=t+l*c+o*h-a*u,this.y=i+l*u+a*c-r*h,this.z=s+l*h+r*u-o*c,this}project(e){return this.applyMatrix4(e.matrixWorldInverse).applyMatrix4(e.projectionMatrix)}unproject(e){return this.applyMatrix4(e.projectionMatrixInverse).applyMatrix4(e.matrixWorld)}transformDirection(e){let t=this.x,i=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[4]*i+r[8]*s,this.y=r[1]*t+r[5]*i+r[9]*s,this.z=r[2]*t+r[6]*i+r[10]*s,this.normalize()}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this}divideScalar(e){return this.multiplyScalar(1/e)}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this}clamp(e,t){return this.x=Je(this.x,e.x,t.x),this.y=Je(this.y,e.y,t.y),this.z=Je(this.z,e.z,t.z),this}clampScalar(e,t){return this.x=Je(this.x,e,t),this.y=Je(this.y,e,t),this.z=Je(this.z,e,t),this}clampLength(e,t){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Je(i,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this}lerpVectors(e,t,i){return this.x=e.x+(t.x-e.x)*i,this.y=e.y+(t.y-e.y)*i,this.z=e.z+(t.z-e.z)*i,this}cross(e){return this.crossVectors(this,e)}crossVectors(e,t){let i=e.x,s=e.y,r=e.z,o=t.x,a=t.y,l=t.z;return this.x=s*l-r*a,this.y=r*o-i*l,this.z=i*a-s*o,this}projectOnVector(e){let t=e.lengthSq();if(t===0)return this.set(0,0,0);let i=e.dot(this)/t;return this.copy(e).multiplyScalar(i)}projectOnPlane(e){return Td.copy(this).projectOnVector(e),this.sub(Td)}reflect(e){return this.sub(Td.copy(e).multiplyScalar(2*this.dot(e)))}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let i=this.dot(e)/t;return Math.acos(Je(i,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,i=this.y-e.y,s=this.z-e.z;return t*t+i*i+s*s}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)+Math.abs(this.z-e.z)}setFromSpherical(e){return this.setFromSphericalCoords(e.radius,e.phi,e.theta)}setFromSphericalCoords(e,t,i){let s=Math.sin(t)*e;return this.x=s*Math.sin(i),this.y=Math.cos(t)*e,this.z=s*Math.cos(i),this}setFromCylindrical(e){return this.setFromCylindricalCoords(e.radius,e.theta,e.y)}setFromCylindricalCoords(e,t,i){return this.x=e*Math.sin(t),this.y=i,this.z=e*Math.cos(t),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this}setFromMatrixScale(e){let t=this.setFromMatrixColumn(e,0).length(),i=this.setFromMatrixColumn(e,1).length(),s=this.setFromMatrixColumn(e,2).length();return this.x=t,this.y=i,this.z=s,this}setFromMatrixColumn(e,t){return this.fromArray(e.elements,t*4)}setFromMatrix3Column(e,t){return this.fromArray(e.elements,t*3)}setFromEuler(e){return this.x=e._x,this.y=e._y,this.z=e._z,this}setFromColor(e){return this.x=e.r,this.y=e.g,this.z=e.b,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let e=Math.random()*Math.PI*2,t=Math.random()*2-1,i=Math.sqrt(1-t*t);return this.x=i*Math.cos(e),this.y=t,this.z=i*Math.sin(e),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},Td=new F,Zg=new en,De=class{static{this.prototype.isMatrix3=!0}constructor(e,t,i,s,r,o,a,l,c){this.elements=[1,0,0,0,1,0,0,0,1],e!==void 0&&this.set(e,t,i,s,r,o,a,l,c)}set(e,t,i,s,r,o,a,l,c){let u=this.elements;return u[0]=e,u[1]=s,u[2]=a,u[3]=t,u[4]=r,u[5]=l,u[6]=i,u[7]=o,u[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(e){let t=this.elements,i=e.elements;return t[0]=i[0],t[1]=i[1],t[2]=i[2],t[3]=i[3],t[4]=i[4],t[5]=i[5],t[6]=i[6],t[7]=i[7],t[8]=i[8],this}extractBasis(e,t,i){return e.setFromMatrix3Column(this,0),t.setFromMatrix3Column(this,1),i.setFromMatrix3Column(this,2),this}setFromMatrix4(e){let t=e.elements;return this.set(t[0],t[4],t[8],t[1],t[5],t[9],t[2],t[6],t[10]),this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let i=e.elements,s=t.elements,r=this.elements,o=i[0],a=i[3],l=i[6],c=i[1],u=i[4],h=i[7],p=i[2],d=i[5],f=i[8],b=s[0],g=s[3],m=s[6],S=s[1],A=s[4],_=s[7],w=s[2],R=s[5],y=s[8];return r[0]=o*b+a*S+l*w,r[3]=o*g+a*A+l*R,r[6]=o*m+a*_+l*y,r[1]=c*b+u*S+h*w,r[4]=c*g+u*A+h*R,r[7]=c*m+u*_+h*y,r[2]=p*b+d*S+f*w,r[5]=p*g+d*A+f*R,r[8]=p*m+d*_+f*y,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[3]*=e,t[6]*=e,t[1]*=e,t[4]*=e,t[7]*=e,t[2]*=e,t[5]*=e,t[8]*=e,this}determinant(){let e=this.elements,t=e[0],i=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],u=e[8];return t*o*u-t*a*c-i*r*u+i*a*l+s*r*c-s*o*l}invert(){let e=this.elements,t=e[0],i=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],u=e[8],h=u*o-a*c,p=a*l-u*r,d=c*r-o*l,f=t*h+i*p+s*d;if(f===0)return this.set(0,0,0,0,0,0,0,0,0);let b=1/f;return e[0]=h*b,e[1]=(s*c-u*i)*b,e[2]=(a*i-s*o)*b,e[3]=p*b,e[4]=(u*t-s*l)*b,e[5]=(s*r-a*t)*b,e[6]=d*b,e[7]=(i*l-c*t)*b,e[8]=(o*t-i*r)*b,this}transpose(){let e,t=this.elements;return e=t[1],t[1]=t[3],t[3]=e,e=t[2],t[2]=t[6],t[6]=e,e=t[5],t[5]=t[7],t[7]=e,this}getNormalMatrix(e){return this.setFromMatrix4(e).invert().transpose()}transposeIntoArray(e){let t=this.elements;return e[0]=t[0],e[1]=t[3],e[2]=t[6],e[3]=t[1],e[4]=t[4],e[5]=t[7],e[6]=t[2],e[7]=t[5],e[8]=t[8],this}setUvTransform(e,t,i,s,r,o,a){let l=Math.cos(r),c=Math.sin(r);return this.set(i*l,i*c,-i*(l*o+c*a)+o+e,-s*c,s*l,-s*(-c*o+l*a)+a+t,0,0,1),this}scale(e,t){return mo("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(Cd.makeScale(e,t)),this}rotate(e){return mo("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(Cd.makeRotation(-e)),this}translate(e,t){return mo("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(Cd.makeTranslation(e,t)),this}makeTranslation(e,t){return e.isVector2?this.set(1,0,e.x,0,1,e.y,0,0,1):this.set(1,0,e,0,1,t,0,0,1),this}makeRotation(e){let t=Math.cos(e),i=Math.sin(e);return this.set(t,-i,0,i,t,0,0,0,1),this}makeScale(e,t){return this.set(e,0,0,0,t,0,0,0,1),this}equals(e){let t=this.elements,i=e.elements;for(let s=0;s<9;s++)if(t[s]!==i[s])return!1;return!0}fromArray(e,t=0){for(let i=0;i<9;i++)this.elements[i]=e[i+t];return this}toArray(e=[],t=0){let i=this.elements;return e[t]=i[0],e[t+1]=i[1],e[t+2]=i[2],e[t+3]=i[3],e[t+4]=i[4],e[t+5]=i[5],e[t+6]=i[6],e[t+7]=i[7],e[t+8]=i[8],e}clone(){return new this.constructor().fromArray(this.elements)}},Cd=new De,Hg=new De().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),Yg=new De().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function c_(){let n={enabled:!0,workingColorSpace:xo,spaces:{},convert:function(s,r,o){return this.enabled===!1||r===o||!r||!o||(this.spaces[r].transfer===ct&&(s.r=Li(s.r),s.g=Li(s.g),s.b=Li(s.b)),this.spaces[r].primaries!==this.spaces[o].primaries&&(s.applyMatrix3(this.spaces[r].toXYZ),s.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===ct&&(s.r=hr(s.r),s.g=hr(s.g),s.b=hr(s.b))),s},workingToColorSpace:function(s,r){return this.convert(s,this.workingColorSpace,r)},colorSpaceToWorking:function(s,r){return this.convert(s,r,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===Oi?vo:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,r=this.workingColorSpace){return s.fromArray(this.spaces[r].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,r,o){return s.copy(this.spaces[o].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},e=[.64,.33,.3,.6,.15,.06],t=[.2126,.7152,.0722],i=[.3127,.329];return n.define({[xo]:{primaries:e,whitePoint:i,transfer:vo,toXYZ:Hg,fromXYZ:Yg,luminanceCoefficients:t,workingColorSpaceConfig:{unpackColorSpace:pn},outputColorSpaceConfig:{drawingBufferColorSpace:pn}},[pn]:{primaries:e,whitePoint:i,transfer:ct,toXYZ:Hg,fromXYZ:Yg,luminanceCoefficients:t,outputColorSpaceConfig:{drawingBufferColorSpace:pn}}}),n}var je=c_();function Li(n){return n<.04045?n*.0773993808:Math.pow(n*.9478672986+.0521327014,2.4)}function hr(n){return n<.0031308?n*12.92:1.055*Math.pow(n,.41666)-.055}var $s,Gl=class{static getDataURL(e,t="image/png"){if(/^data:/i.test(e.src)||typeof HTMLCanvasElement>"u")return e.src;let i;if(e instanceof HTMLCanvasElement)i=e;else{$s===void 0&&($s=So("canvas")),$s.width=e.width,$s.height=e.height;let s=$s.getContext("2d");e instanceof ImageData?s.putImageData(e,0,0):s.drawImage(e,0,0,e.width,e.height),i=$s}return i.toDataURL(t)}static sRGBToLinear(e){if(typeof HTMLImageElement<"u"&&e instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&e instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&e instanceof ImageBitmap){let t=So("canvas");t.width=e.width,t.height=e.height;let i=t.getContext("2d");i.drawImage(e,0,0,e.width,e.height);let s=i.getImageData(0,0,e.width,e.height),r=s.data;for(let o=0;o<r.length;o++)r[o]=Li(r[o]/255)*255;return i.putImageData(s,0,0),t}else if(e.data){let t=e.data.slice(0);for(let i=0;i<t.length;i++)t instanceof Uint8Array||t instanceof Uint8ClampedArray?t[i]=Math.floor(Li(t[i]/255)*255):t[i]=Li(t[i]);return{data:t,width:e.width,height:e.height}}else return Ne("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),e}},u_=0,br=class{constructor(e=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:u_++}),this.uuid=Is(),this.data=e,this.dataReady=!0,this.version=0}getSize(e){let t=this.data;return typeof HTMLVideoElement<"u"&&t instanceof HTMLVideoElement?e.set(t.videoWidth,t.videoHeight,0):typeof VideoFrame<"u"&&t instanceof VideoFrame?e.set(t.displayWidth,t.displayHeight,0):t!==null?e.set(t.width||0,t.height||0,t.depth||0):e.set(0,0,0),e}set needsUpdate(e){e===!0&&this.version++}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.images[this.uuid]!==void 0)return e.images[this.uuid];let i={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let o=0,a=s.length;o<a;o++)s[o].isDataTexture?r.push(Id(s[o].image)):r.push(Id(s[o]))}else r=Id(s);i.url=r}return t||(e.images[this.uuid]=i),i}};function Id(n){return typeof HTMLImageElement<"u"&&n instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&n instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&n instanceof ImageBitmap?Gl.getDataURL(n):n.data?{data:Array.from(n.data),width:n.width,height:n.height,type:n.data.constructor.name}:(Ne("Texture: Unable to serialize Texture."),{})}var d_=0,Nd=new F,yn=class n extends ri{constructor(e=n.DEFAULT_IMAGE,t=n.DEFAULT_MAPPING,i=fi,s=fi,r=gn,o=Gi,a=Hn,l=Mn,c=n.DEFAULT_ANISOTROPY,u=Oi){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:d_++}),this.uuid=Is(),this.name="",this.source=new br(e),this.mipmaps=[],this.mapping=t,this.channel=0,this.wrapS=i,this.wrapT=s,this.magFilter=r,this.minFilter=o,this.anisotropy=c,this.format=a,this.internalFormat=null,this.type=l,this.offset=new Be(0,0),this.repeat=new Be(1,1),this.center=new Be(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new De,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=u,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(e&&e.depth&&e.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(Nd).x}get height(){return this.source.getSize(Nd).y}get depth(){return this.source.getSize(Nd).z}get image(){return this.source.data}set image(e){this.source.data=e}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(e){return this.name=e.name,this.source=e.source,this.mipmaps=e.mipmaps.slice(0),this.mapping=e.mapping,this.channel=e.channel,this.wrapS=e.wrapS,this.wrapT=e.wrapT,this.magFilter=e.magFilter,this.minFilter=e.minFilter,this.anisotropy=e.anisotropy,this.format=e.format,this.internalFormat=e.internalFormat,this.type=e.type,this.normalized=e.normalized,this.offset.copy(e.offset),this.repeat.copy(e.repeat),this.center.copy(e.center),this.rotation=e.rotation,this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrix.copy(e.matrix),this.generateMipmaps=e.generateMipmaps,this.mipmapsAutoUpdate=e.mipmapsAutoUpdate,this.premultiplyAlpha=e.premultiplyAlpha,this.flipY=e.flipY,this.unpackAlignment=e.unpackAlignment,this.colorSpace=e.colorSpace,this.renderTarget=e.renderTarget,this.isRenderTargetTexture=e.isRenderTargetTexture,this.isPMREMTexture=e.isPMREMTexture,this.isArrayTexture=e.isArrayTexture,this.userData=JSON.parse(JSON.stringify(e.userData)),this.needsUpdate=!0,this}setValues(e){for(let t in e){let i=e[t];if(i===void 0){Ne(`Texture.setValues(): parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){Ne(`Texture.setValues(): property '${t}' does not exist.`);continue}s&&i&&s.isVector2&&i.isVector2||s&&i&&s.isVector3&&i.isVector3||s&&i&&s.isMatrix3&&i.isMatrix3?s.copy(i):this[t]=i}}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.textures[this.uuid]!==void 0)return e.textures[this.uuid];let i={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(e).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(i.userData=this.userData),t||(e.textures[this.uuid]=i),i}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(e){if(this.mapping!==bh)return e;if(e.applyMatrix3(this.matrix),e.x<0||e.x>1)switch(this.wrapS){case fr:e.x=e.x-Math.floor(e.x);break;case fi:e.x=e.x<0?0:1;break;case Pl:Math.abs(Math.floor(e.x)%2)===1?e.x=Math.ceil(e.x)-e.x:e.x=e.x-Math.floor(e.x);break}if(e.y<0||e.y>1)switch(this.wrapT){case fr:e.y=e.y-Math.floor(e.y);break;case fi:e.y=e.y<0?0:1;break;case Pl:Math.abs(Math.floor(e.y)%2)===1?e.y=Math.ceil(e.y)-e.y:e.y=e.y-Math.floor(e.y);break}return this.flipY&&(e.y=1-e.y),e}set needsUpdate(e){e===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(e){e===!0&&this.pmremVersion++}};yn.DEFAULT_IMAGE=null;yn.DEFAULT_MAPPING=bh;yn.DEFAULT_ANISOTROPY=1;var mt=class{static{this.prototype.isVector4=!0}constructor(e=0,t=0,i=0,s=1){this.x=e,this.y=t,this.z=i,this.w=s}get width(){return this.z}set width(e){this.z=e}get height(){return this.w}set height(e){this.w=e}set(e,t,i,s){return this.x=e,this.y=t,this.z=i,this.w=s,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this.w=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setW(e){return this.w=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;case 3:this.w=t;break;default:throw new Error("THREE.Vector4: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this.w=e.w!==void 0?e.w:1,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this.w+=e.w,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this.w+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this.w=e.w+t.w,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this.w+=e.w*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this.w-=e.w,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this.w-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this.w=e.w-t.w,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this.w*=e.w,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this.w*=e,this}applyMatrix4(e){let t=this.x,i=this.y,s=this.z,r=this.w,o=e.elements;return this.x=o[0]*t+o[4]*i+o[8]*s+o[12]*r,this.y=o[1]*t+o[5]*i+o[9]*s+o[13]*r,this.z=o[2]*t+o[6]*i+o[10]*s+o[14]*r,this.w=o[3]*t+o[7]*i+o[11]*s+o[15]*r,this}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this.w/=e.w,this}divideScalar(e){return this.multiplyScalar(1/e)}setAxisAngleFromQuaternion(e){this.w=2*Math.acos(e.w);let t=Math.sqrt(1-e.w*e.w);return t<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=e.x/t,this.y=e.y/t,this.z=e.z/t),this}setAxisAngleFromRotationMatrix(e){let t,i,s,r,l=e.elements,c=l[0],u=l[4],h=l[8],p=l[1],d=l[5],f=l[9],b=l[2],g=l[6],m=l[10];if(Math.abs(u-p)<.01&&Math.abs(h-b)<.01&&Math.abs(f-g)<.01){if(Math.abs(u+p)<.1&&Math.abs(h+b)<.1&&Math.abs(f+g)<.1&&Math.abs(c+d+m-3)<.1)return this.set(1,0,0,0),this;t=Math.PI;let A=(c+1)/2,_=(d+1)/2,w=(m+1)/2,R=(u+p)/4,y=(h+b)/4,E=(f+g)/4;return A>_&&A>w?A<.01?(i=0,s=.707106781,r=.707106781):(i=Math.sqrt(A),s=R/i,r=y/i):_>w?_<.01?(i=.707106781,s=0,r=.707106781):(s=Math.sqrt(_),i=R/s,r=E/s):w<.01?(i=.707106781,s=.707106781,r=0):(r=Math.sqrt(w),i=y/r,s=E/r),this.set(i,s,r,t),this}let S=Math.sqrt((g-f)*(g-f)+(h-b)*(h-b)+(p-u)*(p-u));return Math.abs(S)<.001&&(S=1),this.x=(g-f)/S,this.y=(h-b)/S,this.z=(p-u)/S,this.w=Math.acos((c+d+m-1)/2),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this.w=t[15],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this.w=Math.min(this.w,e.w),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this.w=Math.max(this.w,e.w),this}clamp(e,t){return this.x=Je(this.x,e.x,t.x),this.y=Je(this.y,e.y,t.y),this.z=Je(this.z,e.z,t.z),this.w=Je(this.w,e.w,t.w),this}clampScalar(e,t){return this.x=Je(this.x,e,t),this.y=Je(this.y,e,t),this.z=Je(this.z,e,t),this.w=Je(this.w,e,t),this}clampLength(e,t){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Je(i,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z+this.w*e.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this.w+=(e.w-this.w)*t,this}lerpVectors(e,t,i){return this.x=e.x+(t.x-e.x)*i,this.y=e.y+(t.y-e.y)*i,this.z=e.z+(t.z-e.z)*i,this.w=e.w+(t.w-e.w)*i,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z&&e.w===this.w}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this.w=e[t+3],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e[t+3]=this.w,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this.w=e.getW(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},Vl=class extends ri{constructor(e=1,t=1,i={}){super(),i=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:gn,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},i),this.isRenderTarget=!0,this.width=e,this.height=t,this.depth=i.depth,this.scissor=new mt(0,0,e,t),this.scissorTest=!1,this.viewport=new mt(0,0,e,t),this.textures=[];let s=i.count;for(let r=0;r<s;r++)this.textures[r]=new yn({width:e,height:t,depth:i.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(i),this.depthBuffer=i.depthBuffer,this.stencilBuffer=i.stencilBuffer,this.resolveColorBuffer=i.resolveColorBuffer,this.resolveDepthBuffer=i.resolveDepthBuffer,this.resolveStencilBuffer=i.resolveStencilBuffer,this.storeMultisampledColorBuffer=i.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=i.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=i.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=i.depthTexture,this.samples=i.samples,this.multiview=i.multiview,this.useArrayDepthTexture=i.useArrayDepthTexture}_setTextureOptions(e={}){let t={minFilter:gn,generateMipmaps:!1,flipY:!1,internalFormat:null};e.mapping!==void 0&&(t.mapping=e.mapping),e.wrapS!==void 0&&(t.wrapS=e.wrapS),e.wrapT!==void 0&&(t.wrapT=e.wrapT),e.wrapR!==void 0&&(t.wrapR=e.wrapR),e.magFilter!==void 0&&(t.magFilter=e.magFilter),e.minFilter!==void 0&&(t.minFilter=e.minFilter),e.format!==void 0&&(t.format=e.format),e.type!==void 0&&(t.type=e.type),e.anisotropy!==void 0&&(t.anisotropy=e.anisotropy),e.colorSpace!==void 0&&(t.colorSpace=e.colorSpace),e.flipY!==void 0&&(t.flipY=e.flipY),e.generateMipmaps!==void 0&&(t.generateMipmaps=e.generateMipmaps),e.mipmapsAutoUpdate!==void 0&&(t.mipmapsAutoUpdate=e.mipmapsAutoUpdate),e.internalFormat!==void 0&&(t.internalFormat=e.internalFormat);for(let i=0;i<this.textures.length;i++)this.textures[i].setValues(t)}get texture(){return this.textures[0]}set texture(e){this.textures[0]=e}set depthTexture(e){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),e!==null&&e.renderTarget===null&&(e.renderTarget=this),this._depthTexture=e}get depthTexture(){return this._depthTexture}setSize(e,t,i=1){if(this.width!==e||this.height!==t||this.depth!==i){this.width=e,this.height=t,this.depth=i;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=e,this.textures[s].image.height=t,this.textures[s].image.depth=i,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,e,t),this.scissor.set(0,0,e,t)}clone(){return new this.constructor().copy(this)}copy(e){this.width=e.width,this.height=e.height,this.depth=e.depth,this.scissor.copy(e.scissor),this.scissorTest=e.scissorTest,this.viewport.copy(e.viewport),this.textures.length=0;for(let t=0,i=e.textures.length;t<i;t++){this.textures[t]=e.textures[t].clone(),this.textures[t].isRenderTargetTexture=!0,this.textures[t].renderTarget=this;let s=Object.assign({},e.textures[t].image);this.textures[t].source=new br(s)}if(this.depthBuffer=e.depthBuffer,this.stencilBuffer=e.stencilBuffer,this.resolveColorBuffer=e.resolveColorBuffer,this.resolveDepthBuffer=e.resolveDepthBuffer,this.resolveStencilBuffer=e.resolveStencilBuffer,this.storeMultisampledColorBuffer=e.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=e.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=e.storeMultisampledStencilBuffer,e.depthTexture!==null)if(e.depthTexture.renderTarget===e){let t=e.depthTexture.clone();t.renderTarget=null,this.depthTexture=t}else this.depthTexture=e.depthTexture;else this.depthTexture=null;return this.samples=e.samples,this.multiview=e.multiview,this.useArrayDepthTexture=e.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},Bn=class extends Vl{constructor(e=1,t=1,i={}){super(e,t,i),this.isWebGLRenderTarget=!0}},_o=class extends yn{constructor(e=null,t=1,i=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:e,width:t,height:i,depth:s},this.magFilter=Jt,this.minFilter=Jt,this.wrapR=fi,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}addLayerUpdate(e){this.layerUpdates.add(e)}clearLayerUpdates(){this.layerUpdates.clear()}};var Ol=class extends yn{constructor(e=null,t=1,i=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:e,width:t,height:i,depth:s},this.magFilter=Jt,this.minFilter=Jt,this.wrapR=fi,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}};var Ye=class n{static{this.prototype.isMatrix4=!0}constructor(e,t,i,s,r,o,a,l,c,u,h,p,d,f,b,g){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],e!==void 0&&this.set(e,t,i,s,r,o,a,l,c,u,h,p,d,f,b,g)}set(e,t,i,s,r,o,a,l,c,u,h,p,d,f,b,g){let m=this.elements;return m[0]=e,m[4]=t,m[8]=i,m[12]=s,m[1]=r,m[5]=o,m[9]=a,m[13]=l,m[2]=c,m[6]=u,m[10]=h,m[14]=p,m[3]=d,m[7]=f,m[11]=b,m[15]=g,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new n().fromArray(this.elements)}copy(e){let t=this.elements,i=e.elements;return t[0]=i[0],t[1]=i[1],t[2]=i[2],t[3]=i[3],t[4]=i[4],t[5]=i[5],t[6]=i[6],t[7]=i[7],t[8]=i[8],t[9]=i[9],t[10]=i[10],t[11]=i[11],t[12]=i[12],t[13]=i[13],t[14]=i[14],t[15]=i[15],this}copyPosition(e){let t=this.elements,i=e.elements;return t[12]=i[12],t[13]=i[13],t[14]=i[14],this}setFromMatrix3(e){let t=e.elements;return this.set(t[0],t[3],t[6],0,t[1],t[4],t[7],0,t[2],t[5],t[8],0,0,0,0,1),this}extractBasis(e,t,i){return this.determinantAffine()===0?(e.set(1,0,0),t.set(0,1,0),i.set(0,0,1),this):(e.setFromMatrixColumn(this,0),t.setFromMatrixColumn(this,1),i.setFromMatrixColumn(this,2),this)}makeBasis(e,t,i){return this.set(e.x,t.x,i.x,0,e.y,t.y,i.y,0,e.z,t.z,i.z,0,0,0,0,1),this}extractRotation(e){if(e.determinantAffine()===0)return this.identity();let t=this.elements,i=e.elements,s=1/er.setFromMatrixColumn(e,0).length(),r=1/er.setFromMatrixColumn(e,1).length(),o=1/er.setFromMatrixColumn(e,2).length();return t[0]=i[0]*s,t[1]=i[1]*s,t[2]=i[2]*s,t[3]=0,t[4]=i[4]*r,t[5]=i[5]*r,t[6]=i[6]*r,t[7]=0,t[8]=i[8]*o,t[9]=i[9]*o,t[10]=i[10]*o,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromEuler(e){let t=this.elements,i=e.x,s=e.y,r=e.z,o=Math.cos(i),a=Math.sin(i),l=Math.cos(s),c=Math.sin(s),u=Math.cos(r),h=Math.sin(r);if(e.order==="XYZ"){let p=o*u,d=o*h,f=a*u,b=a*h;t[0]=l*u,t[4]=-l*h,t[8]=c,t[1]=d+f*c,t[5]=p-b*c,t[9]=-a*l,t[2]=b-p*c,t[6]=f+d*c,t[10]=o*l}else if(e.order==="YXZ"){let p=l*u,d=l*h,f=c*u,b=c*h;t[0]=p+b*a,t[4]=f*a-d,t[8]=o*c,t[1]=o*h,t[5]=o*u,t[9]=-a,t[2]=d*a-f,t[6]=b+p*a,t[10]=o*l}else if(e.order==="ZXY"){let p=l*u,d=l*h,f=c*u,b=c*h;t[0]=p-b*a,t[4]=-o*h,t[8]=f+d*a,t[1]=d+f*a,t[5]=o*u,t[9]=b-p*a,t[2]=-o*c,t[6]=a,t[10]=o*l}else if(e.order==="ZYX"){let p=o*u,d=o*h,f=a*u,b=a*h;t[0]=l*u,t[4]=f*c-d,t[8]=p*c+b,t[1]=l*h,t[5]=b*c+p,t[9]=d*c-f,t[2]=-c,t[6]=a*l,t[10]=o*l}else if(e.order==="YZX"){let p=o*l,d=o*c,f=a*l,b=a*c;t[0]=l*u,t[4]=b-p*h,t[8]=f*h+d,t[1]=h,t[5]=o*u,t[9]=-a*u,t[2]=-c*u,t[6]=d*h+f,t[10]=p-b*h}else if(e.order==="XZY"){let p=o*l,d=o*c,f=a*l,b=a*c;t[0]=l*u,t[4]=-h,t[8]=c*u,t[1]=p*h+b,t[5]=o*u,t[9]=d*h-f,t[2]=f*h-d,t[6]=a*u,t[10]=b*h+p}return t[3]=0,t[7]=0,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromQuaternion(e){return this.compose(h_,e,p_)}lookAt(e,t,i){let s=this.elements;return Cn.subVectors(e,t),Cn.lengthSq()===0&&(Cn.z=1),Cn.normalize(),Yi.crossVectors(i,Cn),Yi.lengthSq()===0&&(Math.abs(i.z)===1?Cn.x+=1e-4:Cn.z+=1e-4,Cn.normalize(),Yi.crossVectors(i,Cn)),Yi.normalize(),sl.crossVectors(Cn,Yi),s[0]=Yi.x,s[4]=sl.x,s[8]=Cn.x,s[1]=Yi.y,s[5]=sl.y,s[9]=Cn.y,s[2]=Yi.z,s[6]=sl.z,s[10]=Cn.z,this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let i=e.elements,s=t.elements,r=this.elements,o=i[0],a=i[4],l=i[8],c=i[12],u=i[1],h=i[5],p=i[9],d=i[13],f=i[2],b=i[6],g=i[10],m=i[14],S=i[3],A=i[7],_=i[11],w=i[15],R=s[0],y=s[4],E=s[8],L=s[12],C=s[1],P=s[5],D=s[9],W=s[13],I=s[2],X=s[6],Y=s[10],z=s[14],ne=s[3],H=s[7],$=s[11],ee=s[15];return r[0]=o*R+a*C+l*I+c*ne,r[4]=o*y+a*P+l*X+c*H,r[8]=o*E+a*D+l*Y+c*$,r[12]=o*L+a*W+l*z+c*ee,r[1]=u*R+h*C+p*I+d*ne,r[5]=u*y+h*P+p*X+d*H,r[9]=u*E+h*D+p*Y+d*$,r[13]=u*L+h*W+p*z+d*ee,r[2]=f*R+b*C+g*I+m*ne,r[6]=f*y+b*P+g*X+m*H,r[10]=f*E+b*D+g*Y+m*$,r[14]=f*L+b*W+g*z+m*ee,r[3]=S*R+A*C+_*I+w*ne,r[7]=S*y+A*P+_*X+w*H,r[11]=S*E+A*D+_*Y+w*$,r[15]=S*L+A*W+_*z+w*ee,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[4]*=e,t[8]*=e,t[12]*=e,t[1]*=e,t[5]*=e,t[9]*=e,t[13]*=e,t[2]*=e,t[6]*=e,t[10]*=e,t[14]*=e,t[3]*=e,t[7]*=e,t[11]*=e,t[15]*=e,this}determinant(){let e=this.elements,t=e[0],i=e[4],s=e[8],r=e[12],o=e[1],a=e[5],l=e[9],c=e[13],u=e[2],h=e[6],p=e[10],d=e[14],f=e[3],b=e[7],g=e[11],m=e[15],S=l*d-c*p,A=a*d-c*h,_=a*p-l*h,w=o*d-c*u,R=o*p-l*u,y=o*h-a*u;return t*(b*S-g*A+m*_)-i*(f*S-g*w+m*R)+s*(f*A-b*w+m*y)-r*(f*_-b*R+g*y)}determinantAffine(){let e=this.elements,t=e[0],i=e[4],s=e[8],r=e[1],o=e[5],a=e[9],l=e[2],c=e[6],u=e[10];return t*(o*u-a*c)-i*(r*u-a*l)+s*(r*c-o*l)}transpose(){let e=this.elements,t;return t=e[1],e[1]=e[4],e[4]=t,t=e[2],e[2]=e[8],e[8]=t,t=e[6],e[6]=e[9],e[9]=t,t=e[3],e[3]=e[12],e[12]=t,t=e[7],e[7]=e[13],e[13]=t,t=e[11],e[11]=e[14],e[14]=t,this}setPosition(e,t,i){let s=this.elements;return e.isVector3?(s[12]=e.x,s[13]=e.y,s[14]=e.z):(s[12]=e,s[13]=t,s[14]=i),this}invert(){let e=this.elements,t=e[0],i=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],u=e[8],h=e[9],p=e[10],d=e[11],f=e[12],b=e[13],g=e[14],m=e[15],S=t*a-i*o,A=t*l-s*o,_=t*c-r*o,w=i*l-s*a,R=i*c-r*a,y=s*c-r*l,E=u*b-h*f,L=u*g-p*f,C=u*m-d*f,P=h*g-p*b,D=h*m-d*b,W=p*m-d*g,I=S*W-A*D+_*P+w*C-R*L+y*E;if(I===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let X=1/I;return e[0]=(a*W-l*D+c*P)*X,e[1]=(s*D-i*W-r*P)*X,e[2]=(b*y-g*R+m*w)*X,e[3]=(p*R-h*y-d*w)*X,e[4]=(l*C-o*W-c*L)*X,e[5]=(t*W-s*C+r*L)*X,e[6]=(g*_-f*y-m*A)*X,e[7]=(u*y-p*_+d*A)*X,e[8]=(o*D-a*C+c*E)*X,e[9]=(i*C-t*D-r*E)*X,e[10]=(f*R-b*_+m*S)*X,e[11]=(h*_-u*R-d*S)*X,e[12]=(a*L-o*P-l*E)*X,e[13]=(t*P-i*L+s*E)*X,e[14]=(b*A-f*w-g*S)*X,e[15]=(u*w-h*A+p*S)*X,this}scale(e){let t=this.elements,i=e.x,s=e.y,r=e.z;return t[0]*=i,t[4]*=s,t[8]*=r,t[1]*=i,t[5]*=s,t[9]*=r,t[2]*=i,t[6]*=s,t[10]*=r,t[3]*=i,t[7]*=s,t[11]*=r,this}getMaxScaleOnAxis(){let e=this.elements,t=e[0]*e[0]+e[1]*e[1]+e[2]*e[2],i=e[4]*e[4]+e[5]*e[5]+e[6]*e[6],s=e[8]*e[8]+e[9]*e[9]+e[10]*e[10];return Math.sqrt(Math.max(t,i,s))}makeTranslation(e,t,i){return e.isVector3?this.set(1,0,0,e.x,0,1,0,e.y,0,0,1,e.z,0,0,0,1):this.set(1,0,0,e,0,1,0,t,0,0,1,i,0,0,0,1),this}makeRotationX(e){let t=Math.cos(e),i=Math.sin(e);return this.set(1,0,0,0,0,t,-i,0,0,i,t,0,0,0,0,1),this}makeRotationY(e){let t=Math.cos(e),i=Math.sin(e);return this.set(t,0,i,0,0,1,0,0,-i,0,t,0,0,0,0,1),this}makeRotationZ(e){let t=Math.cos(e),i=Math.sin(e);return this.set(t,-i,0,0,i,t,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(e,t){let i=Math.cos(t),s=Math.sin(t),r=1-i,o=e.x,a=e.y,l=e.z,c=r*o,u=r*a;return this.set(c*o+i,c*a-s*l,c*l+s*a,0,c*a+s*l,u*a+i,u*l-s*o,0,c*l-s*a,u*l+s*o,r*l*l+i,0,0,0,0,1),this}makeScale(e,t,i){return this.set(e,0,0,0,0,t,0,0,0,0,i,0,0,0,0,1),this}makeShear(e,t,i,s,r,o){return this.set(1,i,r,0,e,1,o,0,t,s,1,0,0,0,0,1),this}compose(e,t,i){let s=this.elements,r=t._x,o=t._y,a=t._z,l=t._w,c=r+r,u=o+o,h=a+a,p=r*c,d=r*u,f=r*h,b=o*u,g=o*h,m=a*h,S=l*c,A=l*u,_=l*h,w=i.x,R=i.y,y=i.z;return s[0]=(1-(b+m))*w,s[1]=(d+_)*w,s[2]=(f-A)*w,s[3]=0,s[4]=(d-_)*R,s[5]=(1-(p+m))*R,s[6]=(g+S)*R,s[7]=0,s[8]=(f+A)*y,s[9]=(g-S)*y,s[10]=(1-(p+b))*y,s[11]=0,s[12]=e.x,s[13]=e.y,s[14]=e.z,s[15]=1,this}decompose(e,t,i){let s=this.elements;e.x=s[12],e.y=s[13],e.z=s[14];let r=this.determinantAffine();if(r===0)return i.set(1,1,1),t.identity(),this;let o=er.set(s[0],s[1],s[2]).length(),a=er.set(s[4],s[5],s[6]).length(),l=er.set(s[8],s[9],s[10]).length();r<0&&(o=-o),ni.copy(this);let c=1/o,u=1/a,h=1/l;return ni.elements[0]*=c,ni.elements[1]*=c,ni.elements[2]*=c,ni.elements[4]*=u,ni.elements[5]*=u,ni.elements[6]*=u,ni.elements[8]*=h,ni.elements[9]*=h,ni.elements[10]*=h,t.setFromRotationMatrix(ni),i.x=o,i.y=a,i.z=l,this}makePerspective(e,t,i,s,r,o,a=zn,l=!1){let c=this.elements,u=2*r/(t-e),h=2*r/(i-s),p=(t+e)/(t-e),d=(i+s)/(i-s),f,b;if(l)f=r/(o-r),b=o*r/(o-r);else if(a===zn)f=-(o+r)/(o-r),b=-2*o*r/(o-r);else if(a===mr)f=-o/(o-r),b=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return c[0]=u,c[4]=0,c[8]=p,c[12]=0,c[1]=0,c[5]=h,c[9]=d,c[13]=0,c[2]=0,c[6]=0,c[10]=f,c[14]=b,c[3]=0,c[7]=0,c[11]=-1,c[15]=0,this}makeOrthographic(e,t,i,s,r,o,a=zn,l=!1){let c=this.elements,u=2/(t-e),h=2/(i-s),p=-(t+e)/(t-e),d=-(i+s)/(i-s),f,b;if(l)f=1/(o-r),b=o/(o-r);else if(a===zn)f=-2/(o-r),b=-(o+r)/(o-r);else if(a===mr)f=-1/(o-r),b=-r/(o-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return c[0]=u,c[4]=0,c[8]=0,c[12]=p,c[1]=0,c[5]=h,c[9]=0,c[13]=d,c[2]=0,c[6]=0,c[10]=f,c[14]=b,c[3]=0,c[7]=0,c[11]=0,c[15]=1,this}equals(e){let t=this.elements,i=e.elements;for(let s=0;s<16;s++)if(t[s]!==i[s])return!1;return!0}fromArray(e,t=0){for(let i=0;i<16;i++)this.elements[i]=e[i+t];return this}toArray(e=[],t=0){let i=this.elements;return e[t]=i[0],e[t+1]=i[1],e[t+2]=i[2],e[t+3]=i[3],e[t+4]=i[4],e[t+5]=i[5],e[t+6]=i[6],e[t+7]=i[7],e[t+8]=i[8],e[t+9]=i[9],e[t+10]=i[10],e[t+11]=i[11],e[t+12]=i[12],e[t+13]=i[13],e[t+14]=i[14],e[t+15]=i[15],e}},er=new F,ni=new Ye,h_=new F(0,0,0),p_=new F(1,1,1),Yi=new F,sl=new F,Cn=new F,Jg=new Ye,Qg=new en,mi=class n{constructor(e=0,t=0,i=0,s=n.DEFAULT_ORDER){this.isEuler=!0,this._x=e,this._y=t,this._z=i,this._order=s}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get order(){return this._order}set order(e){this._order=e,this._onChangeCallback()}set(e,t,i,s=this._order){return this._x=e,this._y=t,this._z=i,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(e){return this._x=e._x,this._y=e._y,this._z=e._z,this._order=e._order,this._onChangeCallback(),this}setFromRotationMatrix(e,t=this._order,i=!0){let s=e.elements,r=s[0],o=s[4],a=s[8],l=s[1],c=s[5],u=s[9],h=s[2],p=s[6],d=s[10];switch(t){case"XYZ":this._y=Math.asin(Je(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-u,d),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(p,c),this._z=0);break;case"YXZ":this._x=Math.asin(-Je(u,-1,1)),Math.abs(u)<.9999999?(this._y=Math.atan2(a,d),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-h,r),this._z=0);break;case"ZXY":this._x=Math.asin(Je(p,-1,1)),Math.abs(p)<.9999999?(this._y=Math.atan2(-h,d),this._z=Math.atan2(-o,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-Je(h,-1,1)),Math.abs(h)<.9999999?(this._x=Math.atan2(p,d),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-o,c));break;case"YZX":this._z=Math.asin(Je(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-u,c),this._y=Math.atan2(-h,r)):(this._x=0,this._y=Math.atan2(a,d));break;case"XZY":this._z=Math.asin(-Je(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(p,c),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-u,d),this._y=0);break;default:Ne("Euler: .setFromRotationMatrix() encountered an unknown order: "+t)}return this._order=t,i===!0&&this._onChangeCallback(),this}setFromQuaternion(e,t,i){return Jg.makeRotationFromQuaternion(e),this.setFromRotationMatrix(Jg,t,i)}setFromVector3(e,t=this._order){return this.set(e.x,e.y,e.z,t)}reorder(e){return Qg.setFromEuler(this),this.setFromQuaternion(Qg,e)}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._order===this._order}fromArray(e){return this._x=e[0],this._y=e[1],this._z=e[2],e[3]!==void 0&&(this._order=e[3]),this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._order,e}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};mi.DEFAULT_ORDER="XYZ";var xr=class{constructor(){this.mask=1}set(e){this.mask=(1<<e|0)>>>0}enable(e){this.mask|=1<<e|0}enableAll(){this.mask=-1}toggle(e){this.mask^=1<<e|0}disable(e){this.mask&=~(1<<e|0)}disableAll(){this.mask=0}test(e){return(this.mask&e.mask)!==0}isEnabled(e){return(this.mask&(1<<e|0))!==0}},f_=0,Kg=new F,tr=new en,Ti=new Ye,rl=new F,lo=new F,m_=new F,g_=new en,qg=new F(1,0,0),jg=new F(0,1,0),$g=new F(0,0,1),ey={type:"added"},y_={type:"removed"},nr={type:"childadded",child:null},Bd={type:"childremoved",child:null},Qt=class n extends ri{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:f_++}),this.uuid=Is(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=n.DEFAULT_UP.clone();let e=new F,t=new mi,i=new en,s=new F(1,1,1);function r(){i.setFromEuler(t,!1)}function o(){t.setFromQuaternion(i,void 0,!1)}t._onChange(r),i._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:e},rotation:{configurable:!0,enumerable:!0,value:t},quaternion:{configurable:!0,enumerable:!0,value:i},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new Ye},normalMatrix:{value:new De}}),this.matrix=new Ye,this.matrixWorld=new Ye,this.matrixAutoUpdate=n.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=n.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new xr,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(e){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(e),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(e){return this.quaternion.premultiply(e),this}setRotationFromAxisAngle(e,t){this.quaternion.setFromAxisAngle(e,t)}setRotationFromEuler(e){this.quaternion.setFromEuler(e,!0)}setRotationFromMatrix(e){this.quaternion.setFromRotationMatrix(e)}setRotationFromQuaternion(e){this.quaternion.copy(e)}rotateOnAxis(e,t){return tr.setFromAxisAngle(e,t),this.quaternion.multiply(tr),this}rotateOnWorldAxis(e,t){return tr.setFromAxisAngle(e,t),this.quaternion.premultiply(tr),this}rotateX(e){return this.rotateOnAxis(qg,e)}rotateY(e){return this.rotateOnAxis(jg,e)}rotateZ(e){return this.rotateOnAxis($g,e)}translateOnAxis(e,t){return Kg.copy(e).applyQuaternion(this.quaternion),this.position.add(Kg.multiplyScalar(t)),this}translateX(e){return this.translateOnAxis(qg,e)}translateY(e){return this.translateOnAxis(jg,e)}translateZ(e){return this.translateOnAxis($g,e)}localToWorld(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(this.matrixWorld)}worldToLocal(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(Ti.copy(this.matrixWorld).invert())}lookAt(e,t,i){e.isVector3?rl.copy(e):rl.set(e,t,i);let s=this.parent;this.updateWorldMatrix(!0,!1),lo.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?Ti.lookAt(lo,rl,this.up):Ti.lookAt(rl,lo,this.up),this.quaternion.setFromRotationMatrix(Ti),s&&(Ti.extractRotation(s.matrixWorld),tr.setFromRotationMatrix(Ti),this.quaternion.premultiply(tr.invert()))}add(e){if(arguments.length>1){for(let t=0;t<arguments.length;t++)this.add(arguments[t]);return this}return e===this?(Pe("Object3D.add: object can't be added as a child of itself.",e),this):(e&&e.isObject3D?(e.removeFromParent(),e.parent=this,this.children.push(e),e.dispatchEvent(ey),nr.child=e,this.dispatchEvent(nr),nr.child=null):Pe("Object3D.add: object not an instance of THREE.Object3D.",e),this)}remove(e){if(arguments.length>1){for(let i=0;i<arguments.length;i++)this.remove(arguments[i]);return this}let t=this.children.indexOf(e);return t!==-1&&(e.parent=null,this.children.splice(t,1),e.dispatchEvent(y_),Bd.child=e,this.dispatchEvent(Bd),Bd.child=null),this}removeFromParent(){let e=this.parent;return e!==null&&e.remove(this),this}clear(){return this.remove(...this.children)}attach(e){return this.updateWorldMatrix(!0,!1),Ti.copy(this.matrixWorld).invert(),e.parent!==null&&(e.parent.updateWorldMatrix(!0,!1),Ti.multiply(e.parent.matrixWorld)),e.applyMatrix4(Ti),e.removeFromParent(),e.parent=this,this.children.push(e),e.updateWorldMatrix(!1,!0),e.dispatchEvent(ey),nr.child=e,this.dispatchEvent(nr),nr.child=null,this}getObjectById(e){return this.getObjectByProperty("id",e)}getObjectByName(e){return this.getObjectByProperty("name",e)}getObjectByProperty(e,t){if(this[e]===t)return this;for(let i=0,s=this.children.length;i<s;i++){let o=this.children[i].getObjectByProperty(e,t);if(o!==void 0)return o}}getObjectsByProperty(e,t,i=[]){this[e]===t&&i.push(this);let s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].getObjectsByProperty(e,t,i);return i}getWorldPosition(e){return this.updateWorldMatrix(!0,!1),e.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(lo,e,m_),e}getWorldScale(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(lo,g_,e),e}getWorldDirection(e){this.updateWorldMatrix(!0,!1);let t=this.matrixWorld.elements;return e.set(t[8],t[9],t[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(e){e(this);let t=this.children;for(let i=0,s=t.length;i<s;i++)t[i].traverse(e)}traverseVisible(e){if(this.visible===!1)return;e(this);let t=this.children;for(let i=0,s=t.length;i<s;i++)t[i].traverseVisible(e)}traverseAncestors(e){let t=this.parent;t!==null&&(e(t),t.traverseAncestors(e))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let e=this.pivot;if(e!==null){let t=e.x,i=e.y,s=e.z,r=this.matrix.elements;r[12]+=t-r[0]*t-r[4]*i-r[8]*s,r[13]+=i-r[1]*t-r[5]*i-r[9]*s,r[14]+=s-r[2]*t-r[6]*i-r[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(e){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||e)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,e=!0);let t=this.children;for(let i=0,s=t.length;i<s;i++)t[i].updateMatrixWorld(e)}updateWorldMatrix(e,t,i=!1){let s=this.parent;if(e===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||i)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,i=!0),t===!0){let r=this.children;for(let o=0,a=r.length;o<a;o++)r[o].updateWorldMatrix(!1,!0,i)}}toJSON(e){let t=e===void 0||typeof e=="string",i={};t&&(e={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},i.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(a=>({...a})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(e),s.indirectTexture=this._indirectTexture.toJSON(e),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(e)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function r(a,l){return a[l.uuid]===void 0&&(a[l.uuid]=l.toJSON(e)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(e).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(e).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(e.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let l=a.shapes;if(Array.isArray(l))for(let c=0,u=l.length;c<u;c++){let h=l[c];r(e.shapes,h)}else r(e.shapes,l)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(e.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let l=0,c=this.material.length;l<c;l++)a.push(r(e.materials,this.material[l]));s.material=a}else s.material=r(e.materials,this.material);if(this.children.length>0){s.children=[];for(let a=0;a<this.children.length;a++)s.children.push(this.children[a].toJSON(e).object)}if(this.animations.length>0){s.animations=[];for(let a=0;a<this.animations.length;a++){let l=this.animations[a];s.animations.push(r(e.animations,l))}}if(t){let a=o(e.geometries),l=o(e.materials),c=o(e.textures),u=o(e.images),h=o(e.shapes),p=o(e.skeletons),d=o(e.animations),f=o(e.nodes);a.length>0&&(i.geometries=a),l.length>0&&(i.materials=l),c.length>0&&(i.textures=c),u.length>0&&(i.images=u),h.length>0&&(i.shapes=h),p.length>0&&(i.skeletons=p),d.length>0&&(i.animations=d),f.length>0&&(i.nodes=f)}return i.object=s,i;function o(a){let l=[];for(let c in a){let u=a[c];delete u.metadata,l.push(u)}return l}}clone(e){return new this.constructor().copy(this,e)}copy(e,t=!0){if(this.name=e.name,this.up.copy(e.up),this.position.copy(e.position),this.rotation.order=e.rotation.order,this.quaternion.copy(e.quaternion),this.scale.copy(e.scale),this.pivot=e.pivot!==null?e.pivot.clone():null,this.matrix.copy(e.matrix),this.matrixWorld.copy(e.matrixWorld),this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrixWorldAutoUpdate=e.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=e.matrixWorldNeedsUpdate,this.layers.mask=e.layers.mask,this.visible=e.visible,this.castShadow=e.castShadow,this.receiveShadow=e.receiveShadow,this.frustumCulled=e.frustumCulled,this.renderOrder=e.renderOrder,this.static=e.static,this.animations=e.animations.slice(),this.userData=JSON.parse(JSON.stringify(e.userData)),t===!0)for(let i=0;i<e.children.length;i++){let s=e.children[i];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};Qt.DEFAULT_UP=new F(0,1,0);Qt.DEFAULT_MATRIX_AUTO_UPDATE=!0;Qt.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var Nn=class extends Qt{constructor(){super(),this.isGroup=!0,this.type="Group"}},b_={type:"move"},vr=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new Nn,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new Nn,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new F,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new F),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new Nn,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new F,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new F,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(e){return this._targetRay!==null&&this._targetRay.dispatchEvent(e),this._grip!==null&&this._grip.dispatchEvent(e),this._hand!==null&&this._hand.dispatchEvent(e),this}connect(e){if(e&&e.hand){let t=this._hand;if(t)for(let i of e.hand.values())this._getHandJoint(t,i)}return this.dispatchEvent({type:"connected",data:e}),this}disconnect(e){return this.dispatchEvent({type:"disconnected",data:e}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(e,t,i){let s=null,r=null,o=null,a=this._targetRay,l=this._grip,c=this._hand;if(e&&t.session.visibilityState!=="visible-blurred"){if(c&&e.hand){o=!0;for(let b of e.hand.values()){let g=t.getJointPose(b,i),m=this._getHandJoint(c,b);g!==null&&(m.matrix.fromArray(g.transform.matrix),m.matrix.decompose(m.position,m.quaternion,m.scale),m.matrixWorldNeedsUpdate=!0,m.jointRadius=g.radius),m.visible=g!==null}let u=c.joints["index-finger-tip"],h=c.joints["thumb-tip"],p=u.position.distanceTo(h.position),d=.02,f=.005;c.inputState.pinching&&p>d+f?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:e.handedness,target:this})):!c.inputState.pinching&&p<=d-f&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:e.handedness,target:this}))}else l!==null&&e.gripSpace&&(r=t.getPose(e.gripSpace,i),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.quaternion,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1,l.eventsEnabled&&l.dispatchEvent({type:"gripUpdated",data:e,target:this})));a!==null&&(s=t.getPose(e.targetRaySpace,i),s===null&&r!==null&&(s=r),s!==null&&(a.matrix.fromArray(s.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,s.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(s.linearVelocity)):a.hasLinearVelocity=!1,s.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(s.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(b_)))}return a!==null&&(a.visible=s!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=o!==null),this}_getHandJoint(e,t){if(e.joints[t.jointName]===void 0){let i=new Nn;i.matrixAutoUpdate=!1,i.visible=!1,e.joints[t.jointName]=i,e.add(i)}return e.joints[t.jointName]}},lb={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},Ji={h:0,s:0,l:0},ol={h:0,s:0,l:0};function Ld(n,e,t){return t<0&&(t+=1),t>1&&(t-=1),t<1/6?n+(e-n)*6*t:t<1/2?e:t<2/3?n+(e-n)*6*(2/3-t):n}var We=class{constructor(e,t,i){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(e,t,i)}set(e,t,i){if(t===void 0&&i===void 0){let s=e;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(e,t,i);return this}setScalar(e){return this.r=e,this.g=e,this.b=e,this}setHex(e,t=pn){return e=Math.floor(e),this.r=(e>>16&255)/255,this.g=(e>>8&255)/255,this.b=(e&255)/255,je.colorSpaceToWorking(this,t),this}setRGB(e,t,i,s=je.workingColorSpace){return this.r=e,this.g=t,this.b=i,je.colorSpaceToWorking(this,s),this}setHSL(e,t,i,s=je.workingColorSpace){if(e=Nh(e,1),t=Je(t,0,1),i=Je(i,0,1),t===0)this.r=this.g=this.b=i;else{let r=i<=.5?i*(1+t):i+t-i*t,o=2*i-r;this.r=Ld(o,r,e+1/3),this.g=Ld(o,r,e),this.b=Ld(o,r,e-1/3)}return je.colorSpaceToWorking(this,s),this}setStyle(e,t=pn){function i(r){r!==void 0&&parseFloat(r)<1&&Ne("Color: Alpha component of "+e+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(e)){let r,o=s[1],a=s[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,t);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,t);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,t);break;default:Ne("Color: Unknown color model "+e)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(e)){let r=s[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,t);if(o===6)return this.setHex(parseInt(r,16),t);Ne("Color: Invalid hex color "+e)}else if(e&&e.length>0)return this.setColorName(e,t);return this}setColorName(e,t=pn){let i=lb[e.toLowerCase()];return i!==void 0?this.setHex(i,t):Ne("Color: Unknown color "+e),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(e){return this.r=e.r,this.g=e.g,this.b=e.b,this}copySRGBToLinear(e){return this.r=Li(e.r),this.g=Li(e.g),this.b=Li(e.b),this}copyLinearToSRGB(e){return this.r=hr(e.r),this.g=hr(e.g),this.b=hr(e.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(e=pn){return je.workingToColorSpace(ln.copy(this),e),Math.round(Je(ln.r*255,0,255))*65536+Math.round(Je(ln.g*255,0,255))*256+Math.round(Je(ln.b*255,0,255))}getHexString(e=pn){return("000000"+this.getHex(e).toString(16)).slice(-6)}getHSL(e,t=je.workingColorSpace){je.workingToColorSpace(ln.copy(this),t);let i=ln.r,s=ln.g,r=ln.b,o=Math.max(i,s,r),a=Math.min(i,s,r),l,c,u=(a+o)/2;if(a===o)l=0,c=0;else{let h=o-a;switch(c=u<=.5?h/(o+a):h/(2-o-a),o){case i:l=(s-r)/h+(s<r?6:0);break;case s:l=(r-i)/h+2;break;case r:l=(i-s)/h+4;break}l/=6}return e.h=l,e.s=c,e.l=u,e}getRGB(e,t=je.workingColorSpace){return je.workingToColorSpace(ln.copy(this),t),e.r=ln.r,e.g=ln.g,e.b=ln.b,e}getStyle(e=pn){je.workingToColorSpace(ln.copy(this),e);let t=ln.r,i=ln.g,s=ln.b;return e!==pn?`color(${e} ${t.toFixed(3)} ${i.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(t*255)},${Math.round(i*255)},${Math.round(s*255)})`}offsetHSL(e,t,i){return this.getHSL(Ji),this.setHSL(Ji.h+e,Ji.s+t,Ji.l+i)}add(e){return this.r+=e.r,this.g+=e.g,this.b+=e.b,this}addColors(e,t){return this.r=e.r+t.r,this.g=e.g+t.g,this.b=e.b+t.b,this}addScalar(e){return this.r+=e,this.g+=e,this.b+=e,this}sub(e){return this.r=Math.max(0,this.r-e.r),this.g=Math.max(0,this.g-e.g),this.b=Math.max(0,this.b-e.b),this}multiply(e){return this.r*=e.r,this.g*=e.g,this.b*=e.b,this}multiplyScalar(e){return this.r*=e,this.g*=e,this.b*=e,this}lerp(e,t){return this.r+=(e.r-this.r)*t,this.g+=(e.g-this.g)*t,this.b+=(e.b-this.b)*t,this}lerpColors(e,t,i){return this.r=e.r+(t.r-e.r)*i,this.g=e.g+(t.g-e.g)*i,this.b=e.b+(t.b-e.b)*i,this}lerpHSL(e,t){this.getHSL(Ji),e.getHSL(ol);let i=yo(Ji.h,ol.h,t),s=yo(Ji.s,ol.s,t),r=yo(Ji.l,ol.l,t);return this.setHSL(i,s,r),this}setFromVector3(e){return this.r=e.x,this.g=e.y,this.b=e.z,this}applyMatrix3(e){let t=this.r,i=this.g,s=this.b,r=e.elements;return this.r=r[0]*t+r[3]*i+r[6]*s,this.g=r[1]*t+r[4]*i+r[7]*s,this.b=r[2]*t+r[5]*i+r[8]*s,this}equals(e){return e.r===this.r&&e.g===this.g&&e.b===this.b}fromArray(e,t=0){return this.r=e[t],this.g=e[t+1],this.b=e[t+2],this}toArray(e=[],t=0){return e[t]=this.r,e[t+1]=this.g,e[t+2]=this.b,e}fromBufferAttribute(e,t){return this.r=e.getX(t),this.g=e.getY(t),this.b=e.getZ(t),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},ln=new We;We.NAMES=lb;var Eo=class n{constructor(e,t=1,i=1e3){this.isFog=!0,this.name="",this.color=new We(e),this.near=t,this.far=i}clone(){return new n(this.color,this.near,this.far)}toJSON(){return{type:"Fog",name:this.name,color:this.color.getHex(),near:this.near,far:this.far}}},Ao=class extends Qt{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new mi,this.environmentIntensity=1,this.environmentRotation=new mi,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(e,t){return super.copy(e,t),this.background=e.background!==null?e.background.clone():null,this.environment=e.environment!==null?e.environment.clone():null,this.fog=e.fog!==null?e.fog.clone():null,this.backgroundBlurriness=e.backgroundBlurriness,this.backgroundIntensity=e.backgroundIntensity,this.backgroundRotation.copy(e.backgroundRotation),this.environmentIntensity=e.environmentIntensity,this.environmentRotation.copy(e.environmentRotation),this.overrideMaterial=e.overrideMaterial!==null?e.overrideMaterial.clone():null,this.matrixAutoUpdate=e.matrixAutoUpdate,this}toJSON(e){let t=super.toJSON(e);return this.fog!==null&&(t.object.fog=this.fog.toJSON()),t.object.backgroundBlurriness=this.backgroundBlurriness,t.object.backgroundIntensity=this.backgroundIntensity,t.object.backgroundRotation=this.backgroundRotation.toArray(),t.object.environmentIntensity=this.environmentIntensity,t.object.environmentRotation=this.environmentRotation.toArray(),t}},ii=new F,Ci=new F,Fd=new F,Ii=new F,ir=new F,sr=new F,ty=new F,Ud=new F,Pd=new F,Dd=new F,Gd=new mt,Vd=new mt,Od=new mt,ji=class n{constructor(e=new F,t=new F,i=new F){this.a=e,this.b=t,this.c=i}static getNormal(e,t,i,s){s.subVectors(i,t),ii.subVectors(e,t),s.cross(ii);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(e,t,i,s,r){ii.subVectors(s,t),Ci.subVectors(i,t),Fd.subVectors(e,t);let o=ii.dot(ii),a=ii.dot(Ci),l=ii.dot(Fd),c=Ci.dot(Ci),u=Ci.dot(Fd),h=o*c-a*a;if(h===0)return r.set(0,0,0),null;let p=1/h,d=(c*l-a*u)*p,f=(o*u-a*l)*p;return r.set(1-d-f,f,d)}static containsPoint(e,t,i,s){return this.getBarycoord(e,t,i,s,Ii)===null?!1:Ii.x>=0&&Ii.y>=0&&Ii.x+Ii.y<=1}static getInterpolation(e,t,i,s,r,o,a,l){return this.getBarycoord(e,t,i,s,Ii)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,Ii.x),l.addScaledVector(o,Ii.y),l.addScaledVector(a,Ii.z),l)}static getInterpolatedAttribute(e,t,i,s,r,o){return Gd.setScalar(0),Vd.setScalar(0),Od.setScalar(0),Gd.fromBufferAttribute(e,t),Vd.fromBufferAttribute(e,i),Od.fromBufferAttribute(e,s),o.setScalar(0),o.addScaledVector(Gd,r.x),o.addScaledVector(Vd,r.y),o.addScaledVector(Od,r.z),o}static isFrontFacing(e,t,i,s){return ii.subVectors(i,t),Ci.subVectors(e,t),ii.cross(Ci).dot(s)<0}set(e,t,i){return this.a.copy(e),this.b.copy(t),this.c.copy(i),this}setFromPointsAndIndices(e,t,i,s){return this.a.copy(e[t]),this.b.copy(e[i]),this.c.copy(e[s]),this}setFromAttributeAndIndices(e,t,i,s){return this.a.fromBufferAttribute(e,t),this.b.fromBufferAttribute(e,i),this.c.fromBufferAttribute(e,s),this}clone(){return new this.constructor().copy(this)}copy(e){return this.a.copy(e.a),this.b.copy(e.b),this.c.copy(e.c),this}getArea(){return ii.subVectors(this.c,this.b),Ci.subVectors(this.a,this.b),ii.cross(Ci).length()*.5}getMidpoint(e){return e.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(e){return n.getNormal(this.a,this.b,this.c,e)}getPlane(e){return e.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(e,t){return n.getBarycoord(e,this.a,this.b,this.c,t)}getInterpolation(e,t,i,s,r){return n.getInterpolation(e,this.a,this.b,this.c,t,i,s,r)}containsPoint(e){return n.containsPoint(e,this.a,this.b,this.c)}isFrontFacing(e){return n.isFrontFacing(this.a,this.b,this.c,e)}intersectsBox(e){return e.intersectsTriangle(this)}closestPointToPoint(e,t){let i=this.a,s=this.b,r=this.c,o,a;ir.subVectors(s,i),sr.subVectors(r,i),Ud.subVectors(e,i);let l=ir.dot(Ud),c=sr.dot(Ud);if(l<=0&&c<=0)return t.copy(i);Pd.subVectors(e,s);let u=ir.dot(Pd),h=sr.dot(Pd);if(u>=0&&h<=u)return t.copy(s);let p=l*h-u*c;if(p<=0&&l>=0&&u<=0&&l-u>0)return o=l/(l-u),t.copy(i).addScaledVector(ir,o);Dd.subVectors(e,r);let d=ir.dot(Dd),f=sr.dot(Dd);if(f>=0&&d<=f)return t.copy(r);let b=d*c-l*f;if(b<=0&&c>=0&&f<=0)return a=c/(c-f),t.copy(i).addScaledVector(sr,a);let g=u*f-d*h;if(g<=0&&h-u>=0&&d-f>=0)return ty.subVectors(r,s),a=(h-u)/(h-u+(d-f)),t.copy(s).addScaledVector(ty,a);let m=1/(g+b+p);return o=b*m,a=p*m,t.copy(i).addScaledVector(ir,o).addScaledVector(sr,a)}equals(e){return e.a.equals(this.a)&&e.b.equals(this.b)&&e.c.equals(this.c)}},En=class{constructor(e=new F(1/0,1/0,1/0),t=new F(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=e,this.max=t}set(e,t){return this.min.copy(e),this.max.copy(t),this}setFromArray(e){this.makeEmpty();for(let t=0,i=e.length;t<i;t+=3)this.expandByPoint(si.fromArray(e,t));return this}setFromBufferAttribute(e){this.makeEmpty();for(let t=0,i=e.count;t<i;t++)this.expandByPoint(si.fromBufferAttribute(e,t));return this}setFromPoints(e){this.makeEmpty();for(let t=0,i=e.length;t<i;t++)this.expandByPoint(e[t]);return this}setFromCenterAndSize(e,t){let i=si.copy(t).multiplyScalar(.5);return this.min.copy(e).sub(i),this.max.copy(e).add(i),this}setFromObject(e,t=!1){return this.makeEmpty(),this.expandByObject(e,t)}clone(){return new this.constructor().copy(this)}copy(e){return this.min.copy(e.min),this.max.copy(e.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(e){return this.isEmpty()?e.set(0,0,0):e.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(e){return this.isEmpty()?e.set(0,0,0):e.subVectors(this.max,this.min)}expandByPoint(e){return this.min.min(e),this.max.max(e),this}expandByVector(e){return this.min.sub(e),this.max.add(e),this}expandByScalar(e){return this.min.addScalar(-e),this.max.addScalar(e),this}expandByObject(e,t=!1){e.updateWorldMatrix(!1,!1);let i=e.geometry;if(i!==void 0){let r=i.getAttribute("position");if(t===!0&&r!==void 0&&e.isInstancedMesh!==!0&&e.isBatchedMesh!==!0)for(let o=0,a=r.count;o<a;o++)e.isMesh===!0?e.getVertexPosition(o,si):si.fromBufferAttribute(r,o),si.applyMatrix4(e.matrixWorld),this.expandByPoint(si);else e.boundingBox!==void 0?(e.boundingBox===null&&e.computeBoundingBox(),al.copy(e.boundingBox)):(i.boundingBox===null&&i.computeBoundingBox(),al.copy(i.boundingBox)),al.applyMatrix4(e.matrixWorld),this.union(al)}let s=e.children;for(let r=0,o=s.length;r<o;r++)this.expandByObject(s[r],t);return this}containsPoint(e){return e.x>=this.min.x&&e.x<=this.max.x&&e.y>=this.min.y&&e.y<=this.max.y&&e.z>=this.min.z&&e.z<=this.max.z}containsBox(e){return this.min.x<=e.min.x&&e.max.x<=this.max.x&&this.min.y<=e.min.y&&e.max.y<=this.max.y&&this.min.z<=e.min.z&&e.max.z<=this.max.z}getParameter(e,t){return t.set((e.x-this.min.x)/(this.max.x-this.min.x),(e.y-this.min.y)/(this.max.y-this.min.y),(e.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(e){return e.max.x>=this.min.x&&e.min.x<=this.max.x&&e.max.y>=this.min.y&&e.min.y<=this.max.y&&e.max.z>=this.min.z&&e.min.z<=this.max.z}intersectsSphere(e){return this.clampPoint(e.center,si),si.distanceToSquared(e.center)<=e.radius*e.radius}intersectsPlane(e){let t,i;return e.normal.x>0?(t=e.normal.x*this.min.x,i=e.normal.x*this.max.x):(t=e.normal.x*this.max.x,i=e.normal.x*this.min.x),e.normal.y>0?(t+=e.normal.y*this.min.y,i+=e.normal.y*this.max.y):(t+=e.normal.y*this.max.y,i+=e.normal.y*this.min.y),e.normal.z>0?(t+=e.normal.z*this.min.z,i+=e.normal.z*this.max.z):(t+=e.normal.z*this.max.z,i+=e.normal.z*this.min.z),t<=-e.constant&&i>=-e.constant}intersectsTriangle(e){if(this.isEmpty())return!1;this.getCenter(co),ll.subVectors(this.max,co),rr.subVectors(e.a,co),or.subVectors(e.b,co),ar.subVectors(e.c,co),Qi.subVectors(or,rr),Ki.subVectors(ar,or),bs.subVectors(rr,ar);let t=[0,-Qi.z,Qi.y,0,-Ki.z,Ki.y,0,-bs.z,bs.y,Qi.z,0,-Qi.x,Ki.z,0,-Ki.x,bs.z,0,-bs.x,-Qi.y,Qi.x,0,-Ki.y,Ki.x,0,-bs.y,bs.x,0];return!kd(t,rr,or,ar,ll)||(t=[1,0,0,0,1,0,0,0,1],!kd(t,rr,or,ar,ll))?!1:(cl.crossVectors(Qi,Ki),t=[cl.x,cl.y,cl.z],kd(t,rr,or,ar,ll))}clampPoint(e,t){return t.copy(e).clamp(this.min,this.max)}distanceToPoint(e){return this.clampPoint(e,si).distanceTo(e)}getBoundingSphere(e){return this.isEmpty()?e.makeEmpty():(this.getCenter(e.center),e.radius=this.getSize(si).length()*.5),e}intersect(e){return this.min.max(e.min),this.max.min(e.max),this.isEmpty()&&this.makeEmpty(),this}union(e){return this.min.min(e.min),this.max.max(e.max),this}applyMatrix4(e){return this.isEmpty()?this:(Ni[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(e),Ni[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(e),Ni[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(e),Ni[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(e),Ni[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(e),Ni[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(e),Ni[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(e),Ni[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(e),this.setFromPoints(Ni),this)}translate(e){return this.min.add(e),this.max.add(e),this}equals(e){return e.min.equals(this.min)&&e.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(e){return this.min.fromArray(e.min),this.max.fromArray(e.max),this}},Ni=[new F,new F,new F,new F,new F,new F,new F,new F],si=new F,al=new En,rr=new F,or=new F,ar=new F,Qi=new F,Ki=new F,bs=new F,co=new F,ll=new F,cl=new F,xs=new F;function kd(n,e,t,i,s){for(let r=0,o=n.length-3;r<=o;r+=3){xs.fromArray(n,r);let a=s.x*Math.abs(xs.x)+s.y*Math.abs(xs.y)+s.z*Math.abs(xs.z),l=e.dot(xs),c=t.dot(xs),u=i.dot(xs);if(Math.max(-Math.max(l,c,u),Math.min(l,c,u))>a)return!1}return!0}var Ft=new F,ul=new Be,x_=0,Xn=class extends ri{constructor(e,t,i=!1){if(super(),Array.isArray(e))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:x_++}),this.name="",this.array=e,this.itemSize=t,this.count=e!==void 0?e.length/t:0,this.normalized=i,this.usage=tb,this.updateRanges=[],this.gpuType=Zn,this.version=0,this._normalizationScale=e!==void 0?Lh(e):void 0}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.name=e.name,this.array=new e.array.constructor(e.array),this.itemSize=e.itemSize,this.count=e.count,this.normalized=e.normalized,this.usage=e.usage,this.gpuType=e.gpuType,this._normalizationScale=e._normalizationScale,this}copyAt(e,t,i){e*=this.itemSize,i*=t.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[e+s]=t.array[i+s];return this}copyArray(e){return this.array.set(e),this}applyMatrix3(e){if(this.itemSize===2)for(let t=0,i=this.count;t<i;t++)ul.fromBufferAttribute(this,t),ul.applyMatrix3(e),this.setXY(t,ul.x,ul.y);else if(this.itemSize===3)for(let t=0,i=this.count;t<i;t++)Ft.fromBufferAttribute(this,t),Ft.applyMatrix3(e),this.setXYZ(t,Ft.x,Ft.y,Ft.z);return this}applyMatrix4(e){for(let t=0,i=this.count;t<i;t++)Ft.fromBufferAttribute(this,t),Ft.applyMatrix4(e),this.setXYZ(t,Ft.x,Ft.y,Ft.z);return this}applyNormalMatrix(e){for(let t=0,i=this.count;t<i;t++)Ft.fromBufferAttribute(this,t),Ft.applyNormalMatrix(e),this.setXYZ(t,Ft.x,Ft.y,Ft.z);return this}transformDirection(e){for(let t=0,i=this.count;t<i;t++)Ft.fromBufferAttribute(this,t),Ft.transformDirection(e),this.setXYZ(t,Ft.x,Ft.y,Ft.z);return this}set(e,t=0){return this.array.set(e,t),this}getComponent(e,t){let i=this.array[e*this.itemSize+t];return this.normalized&&(i=this._denormalize(i)),i}setComponent(e,t,i){return this.normalized&&(i=this._normalize(i)),this.array[e*this.itemSize+t]=i,this}getX(e){let t=this.array[e*this.itemSize];return this.normalized&&(t=this._denormalize(t)),t}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize]=t,this}getY(e){let t=this.array[e*this.itemSize+1];return this.normalized&&(t=this._denormalize(t)),t}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+1]=t,this}getZ(e){let t=this.array[e*this.itemSize+2];return this.normalized&&(t=this._denormalize(t)),t}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+2]=t,this}getW(e){let t=this.array[e*this.itemSize+3];return this.normalized&&(t=this._denormalize(t)),t}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+3]=t,this}setXY(e,t,i){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),i=this._normalize(i)),this.array[e+0]=t,this.array[e+1]=i,this}setXYZ(e,t,i,s){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),i=this._normalize(i),s=this._normalize(s)),this.array[e+0]=t,this.array[e+1]=i,this.array[e+2]=s,this}setXYZW(e,t,i,s,r){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),i=this._normalize(i),s=this._normalize(s),r=this._normalize(r)),this.array[e+0]=t,this.array[e+1]=i,this.array[e+2]=s,this.array[e+3]=r,this}onUpload(e){return this.onUploadCallback=e,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let e={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return e.name=this.name,e.usage=this.usage,e.gpuType=this.gpuType,e}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):ob(e,this.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):ab(e,this.array)}};var _s=class extends Xn{constructor(e,t,i){super(new Uint16Array(e),t,i)}};var Mo=class extends Xn{constructor(e,t,i){super(new Uint32Array(e),t,i)}};var ft=class extends Xn{constructor(e,t,i){super(new Float32Array(e),t,i)}},v_=new En,uo=new F,Wd=new F,An=class{constructor(e=new F,t=-1){this.isSphere=!0,this.center=e,this.radius=t}set(e,t){return this.center.copy(e),this.radius=t,this}setFromPoints(e,t){let i=this.center;t!==void 0?i.copy(t):v_.setFromPoints(e).getCenter(i);let s=0;for(let r=0,o=e.length;r<o;r++)s=Math.max(s,i.distanceToSquared(e[r]));return this.radius=Math.sqrt(s),this}copy(e){return this.center.copy(e.center),this.radius=e.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(e){return e.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(e){return e.distanceTo(this.center)-this.radius}intersectsSphere(e){let t=this.radius+e.radius;return e.center.distanceToSquared(this.center)<=t*t}intersectsBox(e){return e.intersectsSphere(this)}intersectsPlane(e){return Math.abs(e.distanceToPoint(this.center))<=this.radius}clampPoint(e,t){let i=this.center.distanceToSquared(e);return t.copy(e),i>this.radius*this.radius&&(t.sub(this.center).normalize(),t.multiplyScalar(this.radius).add(this.center)),t}getBoundingBox(e){return this.isEmpty()?(e.makeEmpty(),e):(e.set(this.center,this.center),e.expandByScalar(this.radius),e)}applyMatrix4(e){return this.center.applyMatrix4(e),this.radius=this.radius*e.getMaxScaleOnAxis(),this}translate(e){return this.center.add(e),this}expandByPoint(e){if(this.isEmpty())return this.center.copy(e),this.radius=0,this;uo.subVectors(e,this.center);let t=uo.lengthSq();if(t>this.radius*this.radius){let i=Math.sqrt(t),s=(i-this.radius)*.5;this.center.addScaledVector(uo,s/i),this.radius+=s}return this}union(e){return e.isEmpty()?this:this.isEmpty()?(this.copy(e),this):(this.center.equals(e.center)===!0?this.radius=Math.max(this.radius,e.radius):(Wd.subVectors(e.center,this.center).setLength(e.radius),this.expandByPoint(uo.copy(e.center).add(Wd)),this.expandByPoint(uo.copy(e.center).sub(Wd))),this)}equals(e){return e.center.equals(this.center)&&e.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(e){return this.radius=e.radius,this.center.fromArray(e.center),this}},S_=0,Wn=new Ye,zd=new Qt,lr=new F,In=new En,ho=new En,Yt=new F,Ot=class n extends ri{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:S_++}),this.uuid=Is(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(e){return Array.isArray(e)?this.index=new(HS(e)?Mo:_s)(e,1):this.index=e,this}setIndirect(e,t=0){return this.indirect=e,this.indirectOffset=t,this}getIndirect(){return this.indirect}getAttribute(e){return this.attributes[e]}setAttribute(e,t){return this.attributes[e]=t,this}deleteAttribute(e){return delete this.attributes[e],this}hasAttribute(e){return this.attributes[e]!==void 0}addGroup(e,t,i=0){this.groups.push({start:e,count:t,materialIndex:i})}clearGroups(){this.groups=[]}setDrawRange(e,t){this.drawRange.start=e,this.drawRange.count=t}applyMatrix4(e){let t=this.attributes.position;t!==void 0&&(t.applyMatrix4(e),t.needsUpdate=!0);let i=this.attributes.normal;if(i!==void 0){let r=new De().getNormalMatrix(e);i.applyNormalMatrix(r),i.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(e),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(e){return Wn.makeRotationFromQuaternion(e),this.applyMatrix4(Wn),this}rotateX(e){return Wn.makeRotationX(e),this.applyMatrix4(Wn),this}rotateY(e){return Wn.makeRotationY(e),this.applyMatrix4(Wn),this}rotateZ(e){return Wn.makeRotationZ(e),this.applyMatrix4(Wn),this}translate(e,t,i){return Wn.makeTranslation(e,t,i),this.applyMatrix4(Wn),this}scale(e,t,i){return Wn.makeScale(e,t,i),this.applyMatrix4(Wn),this}lookAt(e){return zd.lookAt(e),zd.updateMatrix(),this.applyMatrix4(zd.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(lr).negate(),this.translate(lr.x,lr.y,lr.z),this}setFromPoints(e){let t=this.getAttribute("position");if(t===void 0){let i=[];for(let s=0,r=e.length;s<r;s++){let o=e[s];i.push(o.x,o.y,o.z||0)}this.setAttribute("position",new ft(i,3))}else{let i=Math.min(e.length,t.count);for(let s=0;s<i;s++){let r=e[s];t.setXYZ(s,r.x,r.y,r.z||0)}e.length>t.count&&Ne("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),t.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new En);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){Pe("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new F(-1/0,-1/0,-1/0),new F(1/0,1/0,1/0));return}if(e!==void 0){if(this.boundingBox.setFromBufferAttribute(e),t)for(let i=0,s=t.length;i<s;i++){let r=t[i];In.setFromBufferAttribute(r),this.morphTargetsRelative?(Yt.addVectors(this.boundingBox.min,In.min),this.boundingBox.expandByPoint(Yt),Yt.addVectors(this.boundingBox.max,In.max),this.boundingBox.expandByPoint(Yt)):(this.boundingBox.expandByPoint(In.min),this.boundingBox.expandByPoint(In.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&Pe('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new An);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){Pe("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new F,1/0);return}if(e){let i=this.boundingSphere.center;if(In.setFromBufferAttribute(e),t)for(let r=0,o=t.length;r<o;r++){let a=t[r];ho.setFromBufferAttribute(a),this.morphTargetsRelative?(Yt.addVectors(In.min,ho.min),In.expandByPoint(Yt),Yt.addVectors(In.max,ho.max),In.expandByPoint(Yt)):(In.expandByPoint(ho.min),In.expandByPoint(ho.max))}In.getCenter(i);let s=0;for(let r=0,o=e.count;r<o;r++)Yt.fromBufferAttribute(e,r),s=Math.max(s,i.distanceToSquared(Yt));if(t)for(let r=0,o=t.length;r<o;r++){let a=t[r],l=this.morphTargetsRelative;for(let c=0,u=a.count;c<u;c++)Yt.fromBufferAttribute(a,c),l&&(lr.fromBufferAttribute(e,c),Yt.add(lr)),s=Math.max(s,i.distanceToSquared(Yt))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&Pe('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let e=this.index,t=this.attributes;if(e===null||t.position===void 0||t.normal===void 0||t.uv===void 0){Pe("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let i=t.position,s=t.normal,r=t.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==i.count)&&(o=new Xn(new Float32Array(4*i.count),4),this.setAttribute("tangent",o));let a=[],l=[],c=new Uint8Array(i.count);for(let L=0;L<i.count;L++)a[L]=new F,l[L]=new F;let u=new F,h=new F,p=new F,d=new Be,f=new Be,b=new Be,g=new F,m=new F;function S(L,C,P){c[L]=c[C]=c[P]=1,u.fromBufferAttribute(i,L),h.fromBufferAttribute(i,C),p.fromBufferAttribute(i,P),d.fromBufferAttribute(r,L),f.fromBufferAttribute(r,C),b.fromBufferAttribute(r,P),h.sub(u),p.sub(u),f.sub(d),b.sub(d);let D=1/(f.x*b.y-b.x*f.y);isFinite(D)&&(g.copy(h).multiplyScalar(b.y).addScaledVector(p,-f.y).multiplyScalar(D),m.copy(p).multiplyScalar(f.x).addScaledVector(h,-b.x).multiplyScalar(D),a[L].add(g),a[C].add(g),a[P].add(g),l[L].add(m),l[C].add(m),l[P].add(m))}let A=this.groups;A.length===0&&(A=[{start:0,count:e.count}]);for(let L=0,C=A.length;L<C;++L){let P=A[L],D=P.start,W=P.count;for(let I=D,X=D+W;I<X;I+=3)S(e.getX(I+0),e.getX(I+1),e.getX(I+2))}let _=new F,w=new F,R=new F,y=new F;function E(L){R.fromBufferAttribute(s,L),y.copy(R);let C=a[L];_.copy(C),_.sub(R.multiplyScalar(R.dot(C))).normalize(),w.crossVectors(y,C);let D=w.dot(l[L])<0?-1:1;o.setXYZW(L,_.x,_.y,_.z,D)}for(let L=0,C=i.count;L<C;++L)c[L]&&E(L);this._transformed=!0}computeVertexNormals(){let e=this.index,t=this.getAttribute("position");if(t!==void 0){let i=this.getAttribute("normal");if(i===void 0||i.count!==t.count)i=new Xn(new Float32Array(t.count*3),3),this.setAttribute("normal",i);else for(let p=0,d=i.count;p<d;p++)i.setXYZ(p,0,0,0);let s=new F,r=new F,o=new F,a=new F,l=new F,c=new F,u=new F,h=new F;if(e)for(let p=0,d=e.count;p<d;p+=3){let f=e.getX(p+0),b=e.getX(p+1),g=e.getX(p+2);s.fromBufferAttribute(t,f),r.fromBufferAttribute(t,b),o.fromBufferAttribute(t,g),u.subVectors(o,r),h.subVectors(s,r),u.cross(h),a.fromBufferAttribute(i,f),l.fromBufferAttribute(i,b),c.fromBufferAttribute(i,g),a.add(u),l.add(u),c.add(u),i.setXYZ(f,a.x,a.y,a.z),i.setXYZ(b,l.x,l.y,l.z),i.setXYZ(g,c.x,c.y,c.z)}else for(let p=0,d=t.count;p<d;p+=3)s.fromBufferAttribute(t,p+0),r.fromBufferAttribute(t,p+1),o.fromBufferAttribute(t,p+2),u.subVectors(o,r),h.subVectors(s,r),u.cross(h),i.setXYZ(p+0,u.x,u.y,u.z),i.setXYZ(p+1,u.x,u.y,u.z),i.setXYZ(p+2,u.x,u.y,u.z);this.normalizeNormals(),i.needsUpdate=!0}}normalizeNormals(){let e=this.attributes.normal;for(let t=0,i=e.count;t<i;t++)Yt.fromBufferAttribute(e,t),Yt.normalize(),e.setXYZ(t,Yt.x,Yt.y,Yt.z)}toNonIndexed(){function e(a,l){let c=a.array,u=a.itemSize,h=a.normalized,p=new c.constructor(l.length*u),d=0,f=0;for(let b=0,g=l.length;b<g;b++){a.isInterleavedBufferAttribute?d=l[b]*a.data.stride+a.offset:d=l[b]*u;for(let m=0;m<u;m++)p[f++]=c[d++]}return new Xn(p,u,h)}if(this.index===null)return Ne("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let t=new n,i=this.index.array,s=this.attributes;for(let a in s){let l=s[a],c=e(l,i);t.setAttribute(a,c)}let r=this.morphAttributes;for(let a in r){let l=[],c=r[a];for(let u=0,h=c.length;u<h;u++){let p=c[u],d=e(p,i);l.push(d)}t.morphAttributes[a]=l}t.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,l=o.length;a<l;a++){let c=o[a];t.addGroup(c.start,c.count,c.materialIndex)}return t}toJSON(){let e={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(e.uuid=this.uuid,e.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,e.name=this.name,Object.keys(this.userData).length>0&&(e.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let l=this.parameters;for(let c in l)l[c]!==void 0&&(e[c]=l[c]);return e}e.data={attributes:{}};let t=this.index;t!==null&&(e.data.index={type:t.array.constructor.name,array:Array.prototype.slice.call(t.array)});let i=this.attributes;for(let l in i){let c=i[l];e.data.attributes[l]=c.toJSON(e.data)}let s={},r=!1;for(let l in this.morphAttributes){let c=this.morphAttributes[l],u=[];for(let h=0,p=c.length;h<p;h++){let d=c[h];u.push(d.toJSON(e.data))}u.length>0&&(s[l]=u,r=!0)}r&&(e.data.morphAttributes=s,e.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(e.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(e.data.boundingSphere=a.toJSON()),e}clone(){return new this.constructor().copy(this)}copy(e){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let t={};this.name=e.name;let i=e.index;i!==null&&this.setIndex(i.clone());let s=e.attributes;for(let c in s){let u=s[c];this.setAttribute(c,u.clone(t))}let r=e.morphAttributes;for(let c in r){let u=[],h=r[c];for(let p=0,d=h.length;p<d;p++)u.push(h[p].clone(t));this.morphAttributes[c]=u}this.morphTargetsRelative=e.morphTargetsRelative;let o=e.groups;for(let c=0,u=o.length;c<u;c++){let h=o[c];this.addGroup(h.start,h.count,h.materialIndex)}let a=e.boundingBox;a!==null&&(this.boundingBox=a.clone());let l=e.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=e.drawRange.start,this.drawRange.count=e.drawRange.count,this.userData=e.userData,this._transformed=e._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}};var Xd=new F,__=new F,E_=new De,fn=class{constructor(e=new F(1,0,0),t=0){this.isPlane=!0,this.normal=e,this.constant=t}set(e,t){return this.normal.copy(e),this.constant=t,this}setComponents(e,t,i,s){return this.normal.set(e,t,i),this.constant=s,this}setFromNormalAndCoplanarPoint(e,t){return this.normal.copy(e),this.constant=-t.dot(this.normal),this}setFromCoplanarPoints(e,t,i){let s=Xd.subVectors(i,t).cross(__.subVectors(e,t)).normalize();return this.setFromNormalAndCoplanarPoint(s,e),this}copy(e){return this.normal.copy(e.normal),this.constant=e.constant,this}normalize(){let e=1/this.normal.length();return this.normal.multiplyScalar(e),this.constant*=e,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(e){return this.normal.dot(e)+this.constant}distanceToSphere(e){return this.distanceToPoint(e.center)-e.radius}projectPoint(e,t){return t.copy(e).addScaledVector(this.normal,-this.distanceToPoint(e))}intersectLine(e,t,i=!0){let s=e.delta(Xd),r=this.normal.dot(s);if(r===0)return this.distanceToPoint(e.start)===0?t.copy(e.start):null;let o=-(e.start.dot(this.normal)+this.constant)/r;return i===!0&&(o<0||o>1)?null:t.copy(e.start).addScaledVector(s,o)}intersectsLine(e){let t=this.distanceToPoint(e.start),i=this.distanceToPoint(e.end);return t<0&&i>0||i<0&&t>0}intersectsBox(e){return e.intersectsPlane(this)}intersectsSphere(e){return e.intersectsPlane(this)}coplanarPoint(e){return e.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(e,t){let i=t||E_.getNormalMatrix(e),s=this.coplanarPoint(Xd).applyMatrix4(e),r=this.normal.applyMatrix3(i).normalize();return this.constant=-s.dot(r),this}translate(e){return this.constant-=e.dot(this.normal),this}equals(e){return e.normal.equals(this.normal)&&e.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(e){return this.normal.fromArray(e.normal),this.constant=e.constant,this}},A_=0,gi=class extends ri{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:A_++}),this.uuid=Is(),this.name="",this.type="Material",this.blending=Rr,this.side=rs,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=uh,this.blendDst=dh,this.blendEquation=ws,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new We(0,0,0),this.blendAlpha=0,this.depthFunc=pr,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=Qy,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=Tl,this.stencilZFail=Tl,this.stencilZPass=Tl,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(e){this._alphaTest>0!=e>0&&this.version++,this._alphaTest=e}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(e){if(e!==void 0)for(let t in e){let i=e[t];if(i===void 0){Ne(`Material: parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){Ne(`Material: '${t}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(i):s&&s.isVector2&&i&&i.isVector2||s&&s.isEuler&&i&&i.isEuler||s&&s.isVector3&&i&&i.isVector3?s.copy(i):this[t]=i}}toJSON(e){let t=e===void 0||typeof e=="string";t&&(e={textures:{},images:{}});let i={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};i.uuid=this.uuid,i.type=this.type,i.blending=this.blending,i.side=this.side,i.shadowSide=this.shadowSide,i.vertexColors=this.vertexColors,i.opacity=this.opacity,i.transparent=this.transparent,i.blendSrc=this.blendSrc,i.blendDst=this.blendDst,i.blendEquation=this.blendEquation,i.blendSrcAlpha=this.blendSrcAlpha,i.blendDstAlpha=this.blendDstAlpha,i.blendEquationAlpha=this.blendEquationAlpha,i.blendColor=this.blendColor.getHex(),i.blendAlpha=this.blendAlpha,i.depthFunc=this.depthFunc,i.depthTest=this.depthTest,i.depthWrite=this.depthWrite,i.colorWrite=this.colorWrite,i.clipIntersection=this.clipIntersection,i.clipShadows=this.clipShadows,i.stencilWriteMask=this.stencilWriteMask,i.stencilFunc=this.stencilFunc,i.stencilRef=this.stencilRef,i.stencilFuncMask=this.stencilFuncMask,i.stencilFail=this.stencilFail,i.stencilZFail=this.stencilZFail,i.stencilZPass=this.stencilZPass,i.stencilWrite=this.stencilWrite,i.polygonOffset=this.polygonOffset,i.polygonOffsetFactor=this.polygonOffsetFactor,i.polygonOffsetUnits=this.polygonOffsetUnits,i.dithering=this.dithering,i.alphaTest=this.alphaTest,i.alphaHash=this.alphaHash,i.alphaToCoverage=this.alphaToCoverage,i.premultipliedAlpha=this.premultipliedAlpha,i.forceSinglePass=this.forceSinglePass,i.allowOverride=this.allowOverride,i.visible=this.visible,i.toneMapped=this.toneMapped,i.name=this.name,this.color&&this.color.isColor&&(i.color=this.color.getHex()),this.roughness!==void 0&&(i.roughness=this.roughness),this.metalness!==void 0&&(i.metalness=this.metalness),this.sheen!==void 0&&(i.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(i.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(i.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(i.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(i.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(i.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(i.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(i.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(i.shininess=this.shininess),this.clearcoat!==void 0&&(i.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(i.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(i.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(i.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(e).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(i.clearcoatMap=this.clearcoatMap.toJSON(e).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(i.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(e).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(i.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(e).uuid,i.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(i.sheenColorMap=this.sheenColorMap.toJSON(e).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(i.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(e).uuid),this.dispersion!==void 0&&(i.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(i.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(i.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(i.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(i.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(i.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(i.iridescenceMap=this.iridescenceMap.toJSON(e).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(i.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(e).uuid),this.anisotropy!==void 0&&(i.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(i.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(i.anisotropyMap=this.anisotropyMap.toJSON(e).uuid),this.map&&this.map.isTexture&&(i.map=this.map.toJSON(e).uuid),this.matcap&&this.matcap.isTexture&&(i.matcap=this.matcap.toJSON(e).uuid),this.alphaMap&&this.alphaMap.isTexture&&(i.alphaMap=this.alphaMap.toJSON(e).uuid),this.lightMap&&this.lightMap.isTexture&&(i.lightMap=this.lightMap.toJSON(e).uuid,i.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(i.aoMap=this.aoMap.toJSON(e).uuid,i.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(i.bumpMap=this.bumpMap.toJSON(e).uuid,i.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(i.normalMap=this.normalMap.toJSON(e).uuid,i.normalMapType=this.normalMapType,i.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(i.displacementMap=this.displacementMap.toJSON(e).uuid,i.displacementScale=this.displacementScale,i.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(i.roughnessMap=this.roughnessMap.toJSON(e).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(i.metalnessMap=this.metalnessMap.toJSON(e).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(i.emissiveMap=this.emissiveMap.toJSON(e).uuid),this.specularMap&&this.specularMap.isTexture&&(i.specularMap=this.specularMap.toJSON(e).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(i.specularIntensityMap=this.specularIntensityMap.toJSON(e).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(i.specularColorMap=this.specularColorMap.toJSON(e).uuid),this.envMap&&this.envMap.isTexture&&(i.envMap=this.envMap.toJSON(e).uuid,this.combine!==void 0&&(i.combine=this.combine)),this.envMapRotation!==void 0&&(i.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(i.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(i.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(i.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(i.gradientMap=this.gradientMap.toJSON(e).uuid),this.transmission!==void 0&&(i.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(i.transmissionMap=this.transmissionMap.toJSON(e).uuid),this.thickness!==void 0&&(i.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(i.thicknessMap=this.thicknessMap.toJSON(e).uuid),this.attenuationDistance!==void 0&&(i.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(i.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(i.size=this.size),this.sizeAttenuation!==void 0&&(i.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(i.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(i.rotation=this.rotation),this.depthPacking!==void 0&&(i.depthPacking=this.depthPacking),this.linewidth!==void 0&&(i.linewidth=this.linewidth),this.linecap!==void 0&&(i.linecap=this.linecap),this.linejoin!==void 0&&(i.linejoin=this.linejoin),this.dashSize!==void 0&&(i.dashSize=this.dashSize),this.gapSize!==void 0&&(i.gapSize=this.gapSize),this.scale!==void 0&&(i.scale=this.scale),this.wireframe!==void 0&&(i.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(i.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(i.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(i.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(i.flatShading=this.flatShading),this.fog!==void 0&&(i.fog=this.fog),Object.keys(this.userData).length>0&&(i.userData=this.userData);function s(r){let o=[];for(let a in r){let l=r[a];delete l.metadata,o.push(l)}return o}if(t){let r=s(e.textures),o=s(e.images);r.length>0&&(i.textures=r),o.length>0&&(i.images=o)}return i}fromJSON(e,t){if(e.uuid!==void 0&&(this.uuid=e.uuid),e.name!==void 0&&(this.name=e.name),e.color!==void 0&&this.color!==void 0&&this.color.setHex(e.color),e.roughness!==void 0&&(this.roughness=e.roughness),e.metalness!==void 0&&(this.metalness=e.metalness),e.sheen!==void 0&&(this.sheen=e.sheen),e.sheenColor!==void 0&&(this.sheenColor=new We().setHex(e.sheenColor)),e.sheenRoughness!==void 0&&(this.sheenRoughness=e.sheenRoughness),e.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(e.emissive),e.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(e.specular),e.specularIntensity!==void 0&&(this.specularIntensity=e.specularIntensity),e.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(e.specularColor),e.shininess!==void 0&&(this.shininess=e.shininess),e.clearcoat!==void 0&&(this.clearcoat=e.clearcoat),e.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=e.clearcoatRoughness),e.diffuseRoughness!==void 0&&(this.diffuseRoughness=e.diffuseRoughness),e.dispersion!==void 0&&(this.dispersion=e.dispersion),e.retroreflectivity!==void 0&&(this.retroreflectivity=e.retroreflectivity),e.iridescence!==void 0&&(this.iridescence=e.iridescence),e.iridescenceIOR!==void 0&&(this.iridescenceIOR=e.iridescenceIOR),e.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessMinimum),e.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=e.iridescenceThicknessMaximum),e.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=e.iridescenceThicknessRange[1]),e.transmission!==void 0&&(this.transmission=e.transmission),e.thickness!==void 0&&(this.thickness=e.thickness),e.attenuationDistance!==void 0&&(this.attenuationDistance=e.attenuationDistance),e.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(e.attenuationColor),e.anisotropy!==void 0&&(this.anisotropy=e.anisotropy),e.anisotropyRotation!==void 0&&(this.anisotropyRotation=e.anisotropyRotation),e.fog!==void 0&&(this.fog=e.fog),e.flatShading!==void 0&&(this.flatShading=e.flatShading),e.blending!==void 0&&(this.blending=e.blending),e.combine!==void 0&&(this.combine=e.combine),e.side!==void 0&&(this.side=e.side),e.shadowSide!==void 0&&(this.shadowSide=e.shadowSide),e.opacity!==void 0&&(this.opacity=e.opacity),e.transparent!==void 0&&(this.transparent=e.transparent),e.alphaTest!==void 0&&(this.alphaTest=e.alphaTest),e.alphaHash!==void 0&&(this.alphaHash=e.alphaHash),e.depthFunc!==void 0&&(this.depthFunc=e.depthFunc),e.depthTest!==void 0&&(this.depthTest=e.depthTest),e.depthWrite!==void 0&&(this.depthWrite=e.depthWrite),e.colorWrite!==void 0&&(this.colorWrite=e.colorWrite),e.clippingPlanes!==void 0&&(this.clippingPlanes=e.clippingPlanes.map(i=>new fn().fromJSON(i))),e.clipIntersection!==void 0&&(this.clipIntersection=e.clipIntersection),e.clipShadows!==void 0&&(this.clipShadows=e.clipShadows),e.depthPacking!==void 0&&(this.depthPacking=e.depthPacking),e.blendSrc!==void 0&&(this.blendSrc=e.blendSrc),e.blendDst!==void 0&&(this.blendDst=e.blendDst),e.blendEquation!==void 0&&(this.blendEquation=e.blendEquation),e.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=e.blendSrcAlpha),e.blendDstAlpha!==void 0&&(this.blendDstAlpha=e.blendDstAlpha),e.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=e.blendEquationAlpha),e.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(e.blendColor),e.blendAlpha!==void 0&&(this.blendAlpha=e.blendAlpha),e.stencilWriteMask!==void 0&&(this.stencilWriteMask=e.stencilWriteMask),e.stencilFunc!==void 0&&(this.stencilFunc=e.stencilFunc),e.stencilRef!==void 0&&(this.stencilRef=e.stencilRef),e.stencilFuncMask!==void 0&&(this.stencilFuncMask=e.stencilFuncMask),e.stencilFail!==void 0&&(this.stencilFail=e.stencilFail),e.stencilZFail!==void 0&&(this.stencilZFail=e.stencilZFail),e.stencilZPass!==void 0&&(this.stencilZPass=e.stencilZPass),e.stencilWrite!==void 0&&(this.stencilWrite=e.stencilWrite),e.wireframe!==void 0&&(this.wireframe=e.wireframe),e.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=e.wireframeLinewidth),e.wireframeLinecap!==void 0&&(this.wireframeLinecap=e.wireframeLinecap),e.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=e.wireframeLinejoin),e.rotation!==void 0&&(this.rotation=e.rotation),e.linewidth!==void 0&&(this.linewidth=e.linewidth),e.linecap!==void 0&&(this.linecap=e.linecap),e.linejoin!==void 0&&(this.linejoin=e.linejoin),e.dashSize!==void 0&&(this.dashSize=e.dashSize),e.gapSize!==void 0&&(this.gapSize=e.gapSize),e.scale!==void 0&&(this.scale=e.scale),e.polygonOffset!==void 0&&(this.polygonOffset=e.polygonOffset),e.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=e.polygonOffsetFactor),e.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=e.polygonOffsetUnits),e.dithering!==void 0&&(this.dithering=e.dithering),e.alphaToCoverage!==void 0&&(this.alphaToCoverage=e.alphaToCoverage),e.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=e.premultipliedAlpha),e.forceSinglePass!==void 0&&(this.forceSinglePass=e.forceSinglePass),e.allowOverride!==void 0&&(this.allowOverride=e.allowOverride),e.visible!==void 0&&(this.visible=e.visible),e.toneMapped!==void 0&&(this.toneMapped=e.toneMapped),e.userData!==void 0&&(this.userData=e.userData),e.vertexColors!==void 0&&(typeof e.vertexColors=="number"?this.vertexColors=e.vertexColors>0:this.vertexColors=e.vertexColors),e.size!==void 0&&(this.size=e.size),e.sizeAttenuation!==void 0&&(this.sizeAttenuation=e.sizeAttenuation),e.map!==void 0&&(this.map=t[e.map]||null),e.matcap!==void 0&&(this.matcap=t[e.matcap]||null),e.alphaMap!==void 0&&(this.alphaMap=t[e.alphaMap]||null),e.bumpMap!==void 0&&(this.bumpMap=t[e.bumpMap]||null),e.bumpScale!==void 0&&(this.bumpScale=e.bumpScale),e.normalMap!==void 0&&(this.normalMap=t[e.normalMap]||null),e.normalMapType!==void 0&&(this.normalMapType=e.normalMapType),e.normalScale!==void 0){let i=e.normalScale;Array.isArray(i)===!1&&(i=[i,i]),this.normalScale=new Be().fromArray(i)}return e.displacementMap!==void 0&&(this.displacementMap=t[e.displacementMap]||null),e.displacementScale!==void 0&&(this.displacementScale=e.displacementScale),e.displacementBias!==void 0&&(this.displacementBias=e.displacementBias),e.roughnessMap!==void 0&&(this.roughnessMap=t[e.roughnessMap]||null),e.metalnessMap!==void 0&&(this.metalnessMap=t[e.metalnessMap]||null),e.emissiveMap!==void 0&&(this.emissiveMap=t[e.emissiveMap]||null),e.emissiveIntensity!==void 0&&(this.emissiveIntensity=e.emissiveIntensity),e.specularMap!==void 0&&(this.specularMap=t[e.specularMap]||null),e.specularIntensityMap!==void 0&&(this.specularIntensityMap=t[e.specularIntensityMap]||null),e.specularColorMap!==void 0&&(this.specularColorMap=t[e.specularColorMap]||null),e.envMap!==void 0&&(this.envMap=t[e.envMap]||null),e.envMapRotation!==void 0&&this.envMapRotation.fromArray(e.envMapRotation),e.envMapIntensity!==void 0&&(this.envMapIntensity=e.envMapIntensity),e.reflectivity!==void 0&&(this.reflectivity=e.reflectivity),e.refractionRatio!==void 0&&(this.refractionRatio=e.refractionRatio),e.lightMap!==void 0&&(this.lightMap=t[e.lightMap]||null),e.lightMapIntensity!==void 0&&(this.lightMapIntensity=e.lightMapIntensity),e.aoMap!==void 0&&(this.aoMap=t[e.aoMap]||null),e.aoMapIntensity!==void 0&&(this.aoMapIntensity=e.aoMapIntensity),e.gradientMap!==void 0&&(this.gradientMap=t[e.gradientMap]||null),e.clearcoatMap!==void 0&&(this.clearcoatMap=t[e.clearcoatMap]||null),e.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=t[e.clearcoatRoughnessMap]||null),e.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=t[e.clearcoatNormalMap]||null),e.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new Be().fromArray(e.clearcoatNormalScale)),e.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=t[e.diffuseRoughnessMap]||null),e.iridescenceMap!==void 0&&(this.iridescenceMap=t[e.iridescenceMap]||null),e.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=t[e.iridescenceThicknessMap]||null),e.transmissionMap!==void 0&&(this.transmissionMap=t[e.transmissionMap]||null),e.thicknessMap!==void 0&&(this.thicknessMap=t[e.thicknessMap]||null),e.anisotropyMap!==void 0&&(this.anisotropyMap=t[e.anisotropyMap]||null),e.sheenColorMap!==void 0&&(this.sheenColorMap=t[e.sheenColorMap]||null),e.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=t[e.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(e){this.name=e.name,this.blending=e.blending,this.side=e.side,this.vertexColors=e.vertexColors,this.opacity=e.opacity,this.transparent=e.transparent,this.blendSrc=e.blendSrc,this.blendDst=e.blendDst,this.blendEquation=e.blendEquation,this.blendSrcAlpha=e.blendSrcAlpha,this.blendDstAlpha=e.blendDstAlpha,this.blendEquationAlpha=e.blendEquationAlpha,this.blendColor.copy(e.blendColor),this.blendAlpha=e.blendAlpha,this.depthFunc=e.depthFunc,this.depthTest=e.depthTest,this.depthWrite=e.depthWrite,this.stencilWriteMask=e.stencilWriteMask,this.stencilFunc=e.stencilFunc,this.stencilRef=e.stencilRef,this.stencilFuncMask=e.stencilFuncMask,this.stencilFail=e.stencilFail,this.stencilZFail=e.stencilZFail,this.stencilZPass=e.stencilZPass,this.stencilWrite=e.stencilWrite;let t=e.clippingPlanes,i=null;if(t!==null){let s=t.length;i=new Array(s);for(let r=0;r!==s;++r)i[r]=t[r].clone()}return this.clippingPlanes=i,this.clipIntersection=e.clipIntersection,this.clipShadows=e.clipShadows,this.shadowSide=e.shadowSide,this.colorWrite=e.colorWrite,this.precision=e.precision,this.polygonOffset=e.polygonOffset,this.polygonOffsetFactor=e.polygonOffsetFactor,this.polygonOffsetUnits=e.polygonOffsetUnits,this.dithering=e.dithering,this.alphaTest=e.alphaTest,this.alphaHash=e.alphaHash,this.alphaToCoverage=e.alphaToCoverage,this.premultipliedAlpha=e.premultipliedAlpha,this.forceSinglePass=e.forceSinglePass,this.allowOverride=e.allowOverride,this.visible=e.visible,this.toneMapped=e.toneMapped,this.userData=JSON.parse(JSON.stringify(e.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(e){e===!0&&this.version++}};var Bi=new F,Zd=new F,dl=new F,hl=new F,oi=class{constructor(e=new F,t=new F(0,0,-1)){this.origin=e,this.direction=t}set(e,t){return this.origin.copy(e),this.direction.copy(t),this}copy(e){return this.origin.copy(e.origin),this.direction.copy(e.direction),this}at(e,t){return t.copy(this.origin).addScaledVector(this.direction,e)}lookAt(e){return this.direction.copy(e).sub(this.origin).normalize(),this}recast(e){return this.origin.copy(this.at(e,Bi)),this}closestPointToPoint(e,t){t.subVectors(e,this.origin);let i=t.dot(this.direction);return i<0?t.copy(this.origin):t.copy(this.origin).addScaledVector(this.direction,i)}distanceToPoint(e){return Math.sqrt(this.distanceSqToPoint(e))}distanceSqToPoint(e){let t=Bi.subVectors(e,this.origin).dot(this.direction);return t<0?this.origin.distanceToSquared(e):(Bi.copy(this.origin).addScaledVector(this.direction,t),Bi.distanceToSquared(e))}distanceSqToSegment(e,t,i,s){Zd.copy(e).add(t).multiplyScalar(.5),dl.copy(t).sub(e).normalize(),hl.copy(this.origin).sub(Zd);let r=e.distanceTo(t)*.5,o=-this.direction.dot(dl),a=hl.dot(this.direction),l=-hl.dot(dl),c=hl.lengthSq(),u=Math.abs(1-o*o),h,p,d,f;if(u>0)if(h=o*l-a,p=o*a-l,f=r*u,h>=0)if(p>=-f)if(p<=f){let b=1/u;h*=b,p*=b,d=h*(h+o*p+2*a)+p*(o*h+p+2*l)+c}else p=r,h=Math.max(0,-(o*p+a)),d=-h*h+p*(p+2*l)+c;else p=-r,h=Math.max(0,-(o*p+a)),d=-h*h+p*(p+2*l)+c;else p<=-f?(h=Math.max(0,-(-o*r+a)),p=h>0?-r:Math.min(Math.max(-r,-l),r),d=-h*h+p*(p+2*l)+c):p<=f?(h=0,p=Math.min(Math.max(-r,-l),r),d=p*(p+2*l)+c):(h=Math.max(0,-(o*r+a)),p=h>0?r:Math.min(Math.max(-r,-l),r),d=-h*h+p*(p+2*l)+c);else p=o>0?-r:r,h=Math.max(0,-(o*p+a)),d=-h*h+p*(p+2*l)+c;return i&&i.copy(this.origin).addScaledVector(this.direction,h),s&&s.copy(Zd).addScaledVector(dl,p),d}intersectSphere(e,t){if(e.radius<0)return null;Bi.subVectors(e.center,this.origin);let i=Bi.dot(this.direction),s=Bi.dot(Bi)-i*i,r=e.radius*e.radius;if(s>r)return null;let o=Math.sqrt(r-s),a=i-o,l=i+o;return l<0?null:a<0?this.at(l,t):this.at(a,t)}intersectsSphere(e){return e.radius<0?!1:this.distanceSqToPoint(e.center)<=e.radius*e.radius}distanceToPlane(e){let t=e.normal.dot(this.direction);if(t===0)return e.distanceToPoint(this.origin)===0?0:null;let i=-(this.origin.dot(e.normal)+e.constant)/t;return i>=0?i:null}intersectPlane(e,t){let i=this.distanceToPlane(e);return i===null?null:this.at(i,t)}intersectsPlane(e){let t=e.distanceToPoint(this.origin);return t===0||e.normal.dot(this.direction)*t<0}intersectBox(e,t){let i,s,r,o,a,l,c=1/this.direction.x,u=1/this.direction.y,h=1/this.direction.z,p=this.origin;return c>=0?(i=(e.min.x-p.x)*c,s=(e.max.x-p.x)*c):(i=(e.max.x-p.x)*c,s=(e.min.x-p.x)*c),u>=0?(r=(e.min.y-p.y)*u,o=(e.max.y-p.y)*u):(r=(e.max.y-p.y)*u,o=(e.min.y-p.y)*u),i>o||r>s||((r>i||isNaN(i))&&(i=r),(o<s||isNaN(s))&&(s=o),h>=0?(a=(e.min.z-p.z)*h,l=(e.max.z-p.z)*h):(a=(e.max.z-p.z)*h,l=(e.min.z-p.z)*h),i>l||a>s)||((a>i||i!==i)&&(i=a),(l<s||s!==s)&&(s=l),s<0)?null:this.at(i>=0?i:s,t)}intersectsBox(e){return this.intersectBox(e,Bi)!==null}intersectTriangle(e,t,i,s,r){let o=this.origin,a=this.direction,l=a.x,c=a.y,u=a.z,h=e.x-o.x,p=e.y-o.y,d=e.z-o.z,f=t.x-o.x,b=t.y-o.y,g=t.z-o.z,m=i.x-o.x,S=i.y-o.y,A=i.z-o.z,_=Math.abs(l),w=Math.abs(c),R=Math.abs(u),y,E,L,C,P,D,W,I,X,Y,z,ne;if(_>=w&&_>=R?(L=l,D=h,X=f,ne=m,l>=0?(y=c,E=u,C=p,P=d,W=b,I=g,Y=S,z=A):(y=u,E=c,C=d,P=p,W=g,I=b,Y=A,z=S)):w>=R?(L=c,D=p,X=b,ne=S,c>=0?(y=u,E=l,C=d,P=h,W=g,I=f,Y=A,z=m):(y=l,E=u,C=h,P=d,W=f,I=g,Y=m,z=A)):(L=u,D=d,X=g,ne=A,u>=0?(y=l,E=c,C=h,P=p,W=f,I=b,Y=m,z=S):(y=c,E=l,C=p,P=h,W=b,I=f,Y=S,z=m)),L===0)return null;let H=y/L,$=E/L,ee=1/L,Me=C-H*D,Oe=P-$*D,K=W-H*X,ye=I-$*X,Se=Y-H*ne,Le=z-$*ne,be=Se*ye-Le*K,ze=Me*Le-Oe*Se,Nt=K*Oe-ye*Me;if(s){if(be<0||ze<0||Nt<0)return null}else if((be<0||ze<0||Nt<0)&&(be>0||ze>0||Nt>0))return null;let Ue=be+ze+Nt;if(Ue===0)return null;let dt=ee*(be*D+ze*X+Nt*ne);return(Ue>0?dt<0:dt>0)?null:this.at(dt/Ue,r)}applyMatrix4(e){return this.origin.applyMatrix4(e),this.direction.transformDirection(e),this}equals(e){return e.origin.equals(this.origin)&&e.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},yi=class extends gi{constructor(e){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new We(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new mi,this.combine=rc,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.fog=e.fog,this}},ny=new Ye,vs=new oi,pl=new An,iy=new F,fl=new F,ml=new F,gl=new F,Hd=new F,yl=new F,sy=new F,bl=new F,Mt=class extends Qt{constructor(e=new Ot,t=new yi){super(),this.isMesh=!0,this.type="Mesh",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}updateMorphTargets(){let t=this.geometry.morphAttributes,i=Object.keys(t);if(i.length>0){let s=t[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(e,t){let i=this.geometry,s=i.attributes.position,r=i.morphAttributes.position,o=i.morphTargetsRelative;t.fromBufferAttribute(s,e);let a=this.morphTargetInfluences;if(r&&a){yl.set(0,0,0);for(let l=0,c=r.length;l<c;l++){let u=a[l],h=r[l];u!==0&&(Hd.fromBufferAttribute(h,e),o?yl.addScaledVector(Hd,u):yl.addScaledVector(Hd.sub(t),u))}t.add(yl)}return t}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let i=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(i.boundingSphere===null&&i.computeBoundingSphere(),pl.copy(i.boundingSphere),pl.applyMatrix4(r),vs.copy(e.ray).recast(e.near),!(pl.containsPoint(vs.origin)===!1&&(vs.intersectSphere(pl,iy)===null||vs.origin.distanceToSquared(iy)>(e.far-e.near)**2))&&(ny.copy(r).invert(),vs.copy(e.ray).applyMatrix4(ny),!(i.boundingBox!==null&&vs.intersectsBox(i.boundingBox)===!1)&&this._computeIntersections(e,t,vs)))}_computeIntersections(e,t,i){let s,r=this.geometry,o=this.material,a=r.index,l=r.attributes.position,c=r.attributes.uv,u=r.attributes.uv1,h=r.attributes.normal,p=r.groups,d=r.drawRange;if(a!==null)if(Array.isArray(o))for(let f=0,b=p.length;f<b;f++){let g=p[f],m=o[g.materialIndex],S=Math.max(g.start,d.start),A=Math.min(a.count,Math.min(g.start+g.count,d.start+d.count));for(let _=S,w=A;_<w;_+=3){let R=a.getX(_),y=a.getX(_+1),E=a.getX(_+2);s=xl(this,m,e,i,c,u,h,R,y,E),s&&(s.faceIndex=Math.floor(_/3),s.face.materialIndex=g.materialIndex,t.push(s))}}else{let f=Math.max(0,d.start),b=Math.min(a.count,d.start+d.count);for(let g=f,m=b;g<m;g+=3){let S=a.getX(g),A=a.getX(g+1),_=a.getX(g+2);s=xl(this,o,e,i,c,u,h,S,A,_),s&&(s.faceIndex=Math.floor(g/3),t.push(s))}}else if(l!==void 0)if(Array.isArray(o))for(let f=0,b=p.length;f<b;f++){let g=p[f],m=o[g.materialIndex],S=Math.max(g.start,d.start),A=Math.min(l.count,Math.min(g.start+g.count,d.start+d.count));for(let _=S,w=A;_<w;_+=3){let R=_,y=_+1,E=_+2;s=xl(this,m,e,i,c,u,h,R,y,E),s&&(s.faceIndex=Math.floor(_/3),s.face.materialIndex=g.materialIndex,t.push(s))}}else{let f=Math.max(0,d.start),b=Math.min(l.count,d.start+d.count);for(let g=f,m=b;g<m;g+=3){let S=g,A=g+1,_=g+2;s=xl(this,o,e,i,c,u,h,S,A,_),s&&(s.faceIndex=Math.floor(g/3),t.push(s))}}}};function M_(n,e,t,i,s,r,o,a){let l;if(e.side===bn?l=i.intersectTriangle(o,r,s,!0,a):l=i.intersectTriangle(s,r,o,e.side===rs,a),l===null)return null;bl.copy(a),bl.applyMatrix4(n.matrixWorld);let c=t.ray.origin.distanceTo(bl);return c<t.near||c>t.far?null:{distance:c,point:bl.clone(),object:n}}function xl(n,e,t,i,s,r,o,a,l,c){n.getVertexPosition(a,fl),n.getVertexPosition(l,ml),n.getVertexPosition(c,gl);let u=M_(n,e,t,i,fl,ml,gl,sy);if(u){let h=new F;ji.getBarycoord(sy,fl,ml,gl,h),s&&(u.uv=ji.getInterpolatedAttribute(s,a,l,c,h,new Be)),r&&(u.uv1=ji.getInterpolatedAttribute(r,a,l,c,h,new Be)),o&&(u.normal=ji.getInterpolatedAttribute(o,a,l,c,h,new F),u.normal.dot(i.direction)>0&&u.normal.multiplyScalar(-1));let p={a,b:l,c,normal:new F,materialIndex:0};ji.getNormal(fl,ml,gl,p.normal),u.face=p,u.barycoord=h}return u}var po=new mt,ry=new mt,oy=new mt,R_=new mt,ay=new Ye,vl=new F,Yd=new An,ly=new Ye,Jd=new oi,Ro=class extends Mt{constructor(e,t){super(e,t),this.isSkinnedMesh=!0,this.type="SkinnedMesh",this.bindMode=qd,this.bindMatrix=new Ye,this.bindMatrixInverse=new Ye,this.boundingBox=null,this.boundingSphere=null}computeBoundingBox(){let e=this.geometry;this.boundingBox===null&&(this.boundingBox=new En),this.boundingBox.makeEmpty();let t=e.getAttribute("position");for(let i=0;i<t.count;i++)this.getVertexPosition(i,vl),this.boundingBox.expandByPoint(vl)}computeBoundingSphere(){let e=this.geometry;this.boundingSphere===null&&(this.boundingSphere=new An),this.boundingSphere.makeEmpty();let t=e.getAttribute("position");for(let i=0;i<t.count;i++)this.getVertexPosition(i,vl),this.boundingSphere.expandByPoint(vl)}copy(e,t){return super.copy(e,t),this.bindMode=e.bindMode,this.bindMatrix.copy(e.bindMatrix),this.bindMatrixInverse.copy(e.bindMatrixInverse),this.skeleton=e.skeleton,this.boundingBox=e.boundingBox!==null?e.boundingBox.clone():null,this.boundingSphere=e.boundingSphere!==null?e.boundingSphere.clone():null,this}raycast(e,t){let i=this.material,s=this.matrixWorld;i!==void 0&&(this.boundingSphere===null&&this.computeBoundingSphere(),Yd.copy(this.boundingSphere),Yd.applyMatrix4(s),e.ray.intersectsSphere(Yd)!==!1&&(ly.copy(s).invert(),Jd.copy(e.ray).applyMatrix4(ly),!(this.boundingBox!==null&&Jd.intersectsBox(this.boundingBox)===!1)&&this._computeIntersections(e,t,Jd)))}getVertexPosition(e,t){return super.getVertexPosition(e,t),this.applyBoneTransform(e,t),t}bind(e,t){this.skeleton=e,t===void 0&&(this.updateMatrixWorld(!0),this.skeleton.calculateInverses(),t=this.matrixWorld),this.bindMatrix.copy(t),this.bindMatrixInverse.copy(t).invert()}pose(){this.skeleton.pose()}normalizeSkinWeights(){let e=new mt,t=this.geometry.attributes.skinWeight;for(let i=0,s=t.count;i<s;i++){e.fromBufferAttribute(t,i);let r=1/e.manhattanLength();r!==1/0?e.multiplyScalar(r):e.set(1,0,0,0),t.setXYZW(i,e.x,e.y,e.z,e.w)}}updateMatrixWorld(e){super.updateMatrixWorld(e),this.bindMode===qd?this.bindMatrixInverse.copy(this.matrixWorld).invert():this.bindMode===Zy?this.bindMatrixInverse.copy(this.bindMatrix).invert():Ne("SkinnedMesh: Unrecognized bindMode: "+this.bindMode)}applyBoneTransform(e,t){let i=this.skeleton,s=this.geometry;ry.fromBufferAttribute(s.attributes.skinIndex,e),oy.fromBufferAttribute(s.attributes.skinWeight,e),t.isVector4?(po.copy(t),t.set(0,0,0,0)):(po.set(t.x,t.y,t.z,1),t.set(0,0,0)),po.applyMatrix4(this.bindMatrix);for(let r=0;r<4;r++){let o=oy.getComponent(r);if(o!==0){let a=ry.getComponent(r);ay.multiplyMatrices(i.bones[a].matrixWorld,i.boneInverses[a]),t.addScaledVector(R_.copy(po).applyMatrix4(ay),o)}}return t.isVector4&&(t.w=po.w),t.applyMatrix4(this.bindMatrixInverse)}},Sr=class extends Qt{constructor(){super(),this.isBone=!0,this.type="Bone"}},wo=class extends yn{constructor(e=null,t=1,i=1,s,r,o,a,l,c=Jt,u=Jt,h,p){super(null,o,a,l,c,u,s,r,h,p),this.isDataTexture=!0,this.image={data:e,width:t,height:i},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}},cy=new Ye,w_=new Ye,To=class n{constructor(e=[],t=[]){this.uuid=Is(),this.bones=e.slice(0),this.boneInverses=t,this.boneMatrices=null,this.previousBoneMatrices=null,this.boneTexture=null,this.previousBoneTexture=null,this.init()}init(){let e=this.bones,t=this.boneInverses;if(this.boneMatrices=new Float32Array(e.length*16),t.length===0)this.calculateInverses();else if(e.length!==t.length){Ne("Skeleton: Number of inverse bone matrices does not match amount of bones."),this.boneInverses=[];for(let i=0,s=this.bones.length;i<s;i++)this.boneInverses.push(new Ye)}}calculateInverses(){this.boneInverses.length=0;for(let e=0,t=this.bones.length;e<t;e++){let i=new Ye;this.bones[e]&&i.copy(this.bones[e].matrixWorld).invert(),this.boneInverses.push(i)}}pose(){for(let e=0,t=this.bones.length;e<t;e++){let i=this.bones[e];i&&i.matrixWorld.copy(this.boneInverses[e]).invert()}for(let e=0,t=this.bones.length;e<t;e++){let i=this.bones[e];i&&(i.parent&&i.parent.isBone?(i.matrix.copy(i.parent.matrixWorld).invert(),i.matrix.multiply(i.matrixWorld)):i.matrix.copy(i.matrixWorld),i.matrix.decompose(i.position,i.quaternion,i.scale))}}update(){let e=this.bones,t=this.boneInverses,i=this.boneMatrices,s=this.boneTexture;for(let r=0,o=e.length;r<o;r++){let a=e[r]?e[r].matrixWorld:w_;cy.multiplyMatrices(a,t[r]),cy.toArray(i,r*16)}s!==null&&(s.needsUpdate=!0)}clone(){return new n(this.bones,this.boneInverses)}computeBoneTexture(){let e=Math.sqrt(this.bones.length*4);e=Math.ceil(e/4)*4,e=Math.max(e,4);let t=new Float32Array(e*e*4);t.set(this.boneMatrices);let i=new wo(t,e,e,Hn,Zn);return i.needsUpdate=!0,this.boneMatrices=t,this.boneTexture=i,this}getBoneByName(e){for(let t=0,i=this.bones.length;t<i;t++){let s=this.bones[t];if(s.name===e)return s}}dispose(){this.boneTexture!==null&&(this.boneTexture.dispose(),this.boneTexture=null),this.previousBoneTexture!==null&&(this.previousBoneTexture.dispose(),this.previousBoneTexture=null)}fromJSON(e,t){this.uuid=e.uuid;for(let i=0,s=e.bones.length;i<s;i++){let r=e.bones[i],o=t[r];o===void 0&&(Ne("Skeleton: No bone found with UUID:",r),o=new Sr),this.bones.push(o),this.boneInverses.push(new Ye().fromArray(e.boneInverses[i]))}return this.init(),this}toJSON(){let e={metadata:{version:4.7,type:"Skeleton",generator:"Skeleton.toJSON"},bones:[],boneInverses:[]};e.uuid=this.uuid;let t=this.bones,i=this.boneInverses;for(let s=0,r=t.length;s<r;s++){let o=t[s];e.bones.push(o.uuid);let a=i[s];e.boneInverses.push(a.toArray())}return e}};var Ss=new An,T_=new Be(.5,.5),Sl=new F,$i=class{constructor(e=new fn,t=new fn,i=new fn,s=new fn,r=new fn,o=new fn){this.planes=[e,t,i,s,r,o]}set(e,t,i,s,r,o){let a=this.planes;return a[0].copy(e),a[1].copy(t),a[2].copy(i),a[3].copy(s),a[4].copy(r),a[5].copy(o),this}copy(e){let t=this.planes;for(let i=0;i<6;i++)t[i].copy(e.planes[i]);return this}setFromProjectionMatrix(e,t=zn,i=!1){let s=this.planes,r=e.elements,o=r[0],a=r[1],l=r[2],c=r[3],u=r[4],h=r[5],p=r[6],d=r[7],f=r[8],b=r[9],g=r[10],m=r[11],S=r[12],A=r[13],_=r[14],w=r[15];if(s[0].setComponents(c-o,d-u,m-f,w-S).normalize(),s[1].setComponents(c+o,d+u,m+f,w+S).normalize(),s[2].setComponents(c+a,d+h,m+b,w+A).normalize(),s[3].setComponents(c-a,d-h,m-b,w-A).normalize(),i)s[4].setComponents(l,p,g,_).normalize(),s[5].setComponents(c-l,d-p,m-g,w-_).normalize();else if(s[4].setComponents(c-l,d-p,m-g,w-_).normalize(),t===zn)s[5].setComponents(c+l,d+p,m+g,w+_).normalize();else if(t===mr)s[5].setComponents(l,p,g,_).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+t);return this}intersectsObject(e){if(e.boundingSphere!==void 0)e.boundingSphere===null&&e.computeBoundingSphere(),Ss.copy(e.boundingSphere).applyMatrix4(e.matrixWorld);else{let t=e.geometry;t.boundingSphere===null&&t.computeBoundingSphere(),Ss.copy(t.boundingSphere).applyMatrix4(e.matrixWorld)}return this.intersectsSphere(Ss)}intersectsSprite(e){Ss.center.set(0,0,0);let t=T_.distanceTo(e.center);return Ss.radius=.7071067811865476+t,Ss.applyMatrix4(e.matrixWorld),this.intersectsSphere(Ss)}intersectsSphere(e){let t=this.planes,i=e.center,s=-e.radius;for(let r=0;r<6;r++)if(t[r].distanceToPoint(i)<s)return!1;return!0}intersectsBox(e){let t=this.planes;for(let i=0;i<6;i++){let s=t[i];if(Sl.x=s.normal.x>0?e.max.x:e.min.x,Sl.y=s.normal.y>0?e.max.y:e.min.y,Sl.z=s.normal.z>0?e.max.z:e.min.z,s.distanceToPoint(Sl)<0)return!1}return!0}containsPoint(e){let t=this.planes;for(let i=0;i<6;i++)if(t[i].distanceToPoint(e)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},uy=new Ye,kl=class n{constructor(){this.coordinateSystem=zn,this._frustums=[],this._count=0}setFromArrayCamera(e){let t=e.cameras,i=this._frustums;for(let s=0;s<t.length;s++){let r=t[s];uy.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),i[s]===void 0&&(i[s]=new $i),i[s].setFromProjectionMatrix(uy,r.coordinateSystem,r.reversedDepth)}return this._count=t.length,this}getFrustum(e){return this._frustums[e]}intersectsObject(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].intersectsObject(e))return!0;return!1}intersectsSprite(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].intersectsSprite(e))return!0;return!1}intersectsSphere(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].intersectsSphere(e))return!0;return!1}intersectsBox(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].intersectsBox(e))return!0;return!1}containsPoint(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].containsPoint(e))return!0;return!1}copy(e){this.coordinateSystem=e.coordinateSystem;let t=this._frustums,i=e._frustums;for(let s=0;s<e._count;s++)t[s]===void 0&&(t[s]=new $i),t[s].copy(i[s]);return this._count=e._count,this}clone(){return new n().copy(this)}};var Es=class extends gi{constructor(e){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new We(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.linewidth=e.linewidth,this.linecap=e.linecap,this.linejoin=e.linejoin,this.fog=e.fog,this}},Wl=new F,zl=new F,dy=new Ye,fo=new oi,_l=new An,Qd=new F,hy=new F,As=class extends Qt{constructor(e=new Ot,t=new Es){super(),this.isLine=!0,this.type="Line",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,i=[0];for(let s=1,r=t.count;s<r;s++)Wl.fromBufferAttribute(t,s-1),zl.fromBufferAttribute(t,s),i[s]=i[s-1],i[s]+=Wl.distanceTo(zl);e.setAttribute("lineDistance",new ft(i,1))}else Ne("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let i=this.geometry,s=this.matrixWorld,r=e.params.Line.threshold,o=i.drawRange;if(i.boundingSphere===null&&i.computeBoundingSphere(),_l.copy(i.boundingSphere),_l.applyMatrix4(s),_l.radius+=r,e.ray.intersectsSphere(_l)===!1)return;dy.copy(s).invert(),fo.copy(e.ray).applyMatrix4(dy);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=this.isLineSegments?2:1,u=i.index,p=i.attributes.position;if(u!==null){let d=Math.max(0,o.start),f=Math.min(u.count,o.start+o.count);for(let b=d,g=f-1;b<g;b+=c){let m=u.getX(b),S=u.getX(b+1),A=El(this,e,fo,l,m,S,b);A&&t.push(A)}if(this.isLineLoop){let b=u.getX(f-1),g=u.getX(d),m=El(this,e,fo,l,b,g,f-1);m&&t.push(m)}}else{let d=Math.max(0,o.start),f=Math.min(p.count,o.start+o.count);for(let b=d,g=f-1;b<g;b+=c){let m=El(this,e,fo,l,b,b+1,b);m&&t.push(m)}if(this.isLineLoop){let b=El(this,e,fo,l,f-1,d,f-1);b&&t.push(b)}}}updateMorphTargets(){let t=this.geometry.morphAttributes,i=Object.keys(t);if(i.length>0){let s=t[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function El(n,e,t,i,s,r,o){let a=n.geometry.attributes.position;if(Wl.fromBufferAttribute(a,s),zl.fromBufferAttribute(a,r),t.distanceSqToSegment(Wl,zl,Qd,hy)>i)return;Qd.applyMatrix4(n.matrixWorld);let c=e.ray.origin.distanceTo(Qd);if(!(c<e.near||c>e.far))return{distance:c,point:hy.clone().applyMatrix4(n.matrixWorld),index:o,face:null,faceIndex:null,barycoord:null,object:n}}var Co=class extends As{constructor(e,t){super(e,t),this.isLineLoop=!0,this.type="LineLoop"}};var Io=class extends yn{constructor(e=[],t=Ts,i,s,r,o,a,l,c,u){super(e,t,i,s,r,o,a,l,c,u),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(e){this.image=e}},No=class extends yn{constructor(e,t,i,s,r,o,a,l,c){super(e,t,i,s,r,o,a,l,c),this.isCanvasTexture=!0,this.needsUpdate=!0}};var Ui=class extends yn{constructor(e,t,i=ci,s,r,o,a=Jt,l=Jt,c,u=Fi,h=1){if(u!==Fi&&u!==Vi)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let p={width:e,height:t,depth:h};super(p,s,r,o,a,l,u,i,c),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(e){return super.copy(e),this.source=new br(Object.assign({},e.image)),this.compareFunction=e.compareFunction,this}toJSON(e){let t=super.toJSON(e);return t.compareFunction=this.compareFunction,t}},Bo=class extends Ui{constructor(e,t=ci,i=Ts,s,r,o=Jt,a=Jt,l,c=Fi){let u={width:e,height:e,depth:1},h=[u,u,u,u,u,u];super(e,e,t,i,s,r,o,a,l,c),this.image=h,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(e){this.image=e}},Lo=class extends yn{constructor(e=null){super(),this.sourceTexture=e,this.isExternalTexture=!0}copy(e){return super.copy(e),this.sourceTexture=e.sourceTexture,this}},ai=class n extends Ot{constructor(e=1,t=1,i=1,s=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:e,height:t,depth:i,widthSegments:s,heightSegments:r,depthSegments:o};let a=this;s=Math.floor(s),r=Math.floor(r),o=Math.floor(o);let l=[],c=[],u=[],h=[],p=0,d=0;f("z","y","x",-1,-1,i,t,e,o,r,0),f("z","y","x",1,-1,i,t,-e,o,r,1),f("x","z","y",1,1,e,i,t,s,o,2),f("x","z","y",1,-1,e,i,-t,s,o,3),f("x","y","z",1,-1,e,t,i,s,r,4),f("x","y","z",-1,-1,e,t,-i,s,r,5),this.setIndex(l),this.setAttribute("position",new ft(c,3)),this.setAttribute("normal",new ft(u,3)),this.setAttribute("uv",new ft(h,2));function f(b,g,m,S,A,_,w,R,y,E,L){let C=_/y,P=w/E,D=_/2,W=w/2,I=R/2,X=y+1,Y=E+1,z=0,ne=0,H=new F;for(let $=0;$<Y;$++){let ee=$*P-W;for(let Me=0;Me<X;Me++){let Oe=Me*C-D;H[b]=Oe*S,H[g]=ee*A,H[m]=I,c.push(H.x,H.y,H.z),H[b]=0,H[g]=0,H[m]=R>0?1:-1,u.push(H.x,H.y,H.z),h.push(Me/y),h.push(1-$/E),z+=1}}for(let $=0;$<E;$++)for(let ee=0;ee<y;ee++){let Me=p+ee+X*$,Oe=p+ee+X*($+1),K=p+(ee+1)+X*($+1),ye=p+(ee+1)+X*$;l.push(Me,Oe,ye),l.push(Oe,K,ye),ne+=6}a.addGroup(d,ne,L),d+=ne,p+=z}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.width,e.height,e.depth,e.widthSegments,e.heightSegments,e.depthSegments)}},Fo=class n extends Ot{constructor(e=1,t=1,i=4,s=8,r=1){super(),this.type="CapsuleGeometry",this.parameters={radius:e,height:t,capSegments:i,radialSegments:s,heightSegments:r},t=Math.max(0,t),i=Math.max(1,Math.floor(i)),s=Math.max(3,Math.floor(s)),r=Math.max(1,Math.floor(r));let o=[],a=[],l=[],c=[],u=t/2,h=Math.PI/2*e,p=t,d=2*h+p,f=i*2+r,b=s+1,g=new F,m=new F;for(let S=0;S<=f;S++){let A=0,_=0,w=0,R=0;if(S<=i){let L=S/i,C=L*Math.PI/2;_=-u-e*Math.cos(C),w=e*Math.sin(C),R=-e*Math.cos(C),A=L*h}else if(S<=i+r){let L=(S-i)/r;_=-u+L*t,w=e,R=0,A=h+L*p}else{let L=(S-i-r)/i,C=L*Math.PI/2;_=u+e*Math.sin(C),w=e*Math.cos(C),R=e*Math.sin(C),A=h+p+L*h}let y=Math.max(0,Math.min(1,A/d)),E=0;S===0?E=.5/s:S===f&&(E=-.5/s);for(let L=0;L<=s;L++){let C=L/s,P=C*Math.PI*2,D=Math.sin(P),W=Math.cos(P);m.x=-w*W,m.y=_,m.z=w*D,a.push(m.x,m.y,m.z),g.set(-w*W,R,w*D),g.normalize(),l.push(g.x,g.y,g.z),c.push(C+E,y)}if(S>0){let L=(S-1)*b;for(let C=0;C<s;C++){let P=L+C,D=L+C+1,W=S*b+C,I=S*b+C+1;o.push(P,D,W),o.push(D,I,W)}}}this.setIndex(o),this.setAttribute("position",new ft(a,3)),this.setAttribute("normal",new ft(l,3)),this.setAttribute("uv",new ft(c,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.radius,e.height,e.capSegments,e.radialSegments,e.heightSegments)}};var _r=class n extends Ot{constructor(e=1,t=1,i=1,s=32,r=1,o=!1,a=0,l=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:e,radiusBottom:t,height:i,radialSegments:s,heightSegments:r,openEnded:o,thetaStart:a,thetaLength:l};let c=this;s=Math.floor(s),r=Math.floor(r);let u=[],h=[],p=[],d=[],f=0,b=[],g=i/2,m=0;S(),o===!1&&(e>0&&A(!0),t>0&&A(!1)),this.setIndex(u),this.setAttribute("position",new ft(h,3)),this.setAttribute("normal",new ft(p,3)),this.setAttribute("uv",new ft(d,2));function S(){let _=new F,w=new F,R=0,y=(t-e)/i;for(let E=0;E<=r;E++){let L=[],C=E/r,P=C*(t-e)+e;for(let D=0;D<=s;D++){let W=D/s,I=W*l+a,X=Math.sin(I),Y=Math.cos(I);w.x=P*X,w.y=-C*i+g,w.z=P*Y,h.push(w.x,w.y,w.z),_.set(X,y,Y).normalize(),p.push(_.x,_.y,_.z),d.push(W,1-C),L.push(f++)}b.push(L)}for(let E=0;E<s;E++)for(let L=0;L<r;L++){let C=b[L][E],P=b[L+1][E],D=b[L+1][E+1],W=b[L][E+1];(e>0||L!==0)&&(u.push(C,P,W),R+=3),(t>0||L!==r-1)&&(u.push(P,D,W),R+=3)}c.addGroup(m,R,0),m+=R}function A(_){let w=f,R=new Be,y=new F,E=0,L=_===!0?e:t,C=_===!0?1:-1;for(let D=1;D<=s;D++)h.push(0,g*C,0),p.push(0,C,0),d.push(.5,.5),f++;let P=f;for(let D=0;D<=s;D++){let I=D/s*l+a,X=Math.cos(I),Y=Math.sin(I);y.x=L*Y,y.y=g*C,y.z=L*X,h.push(y.x,y.y,y.z),p.push(0,C,0),R.x=X*.5+.5,R.y=Y*.5*C+.5,d.push(R.x,R.y),f++}for(let D=0;D<s;D++){let W=w+D,I=P+D;_===!0?u.push(I,I+1,W):u.push(I+1,I,W),E+=3}c.addGroup(m,E,_===!0?1:2),m+=E}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.radiusTop,e.radiusBottom,e.height,e.radialSegments,e.heightSegments,e.openEnded,e.thetaStart,e.thetaLength)}},Uo=class n extends _r{constructor(e=1,t=1,i=32,s=1,r=!1,o=0,a=Math.PI*2){super(0,e,t,i,s,r,o,a),this.type="ConeGeometry",this.parameters={radius:e,height:t,radialSegments:i,heightSegments:s,openEnded:r,thetaStart:o,thetaLength:a}}static fromJSON(e){return new n(e.radius,e.height,e.radialSegments,e.heightSegments,e.openEnded,e.thetaStart,e.thetaLength)}};var Pi=class n extends Ot{constructor(e=1,t=1,i=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:e,height:t,widthSegments:i,heightSegments:s};let r=e/2,o=t/2,a=Math.floor(i),l=Math.floor(s),c=a+1,u=l+1,h=e/a,p=t/l,d=[],f=[],b=[],g=[];for(let m=0;m<u;m++){let S=m*p-o;for(let A=0;A<c;A++){let _=A*h-r;f.push(_,-S,0),b.push(0,0,1),g.push(A/a),g.push(1-m/l)}}for(let m=0;m<l;m++)for(let S=0;S<a;S++){let A=S+c*m,_=S+c*(m+1),w=S+1+c*(m+1),R=S+1+c*m;d.push(A,_,R),d.push(_,w,R)}this.setIndex(d),this.setAttribute("position",new ft(f,3)),this.setAttribute("normal",new ft(b,3)),this.setAttribute("uv",new ft(g,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.width,e.height,e.widthSegments,e.heightSegments)}},Po=class n extends Ot{constructor(e=.5,t=1,i=32,s=1,r=0,o=Math.PI*2){super(),this.type="RingGeometry",this.parameters={innerRadius:e,outerRadius:t,thetaSegments:i,phiSegments:s,thetaStart:r,thetaLength:o},i=Math.max(3,i),s=Math.max(1,s);let a=[],l=[],c=[],u=[],h=e,p=(t-e)/s,d=new F,f=new Be;for(let b=0;b<=s;b++){for(let g=0;g<=i;g++){let m=r+g/i*o;d.x=h*Math.cos(m),d.y=h*Math.sin(m),l.push(d.x,d.y,d.z),c.push(0,0,1),f.x=(d.x/t+1)/2,f.y=(d.y/t+1)/2,u.push(f.x,f.y)}h+=p}for(let b=0;b<s;b++){let g=b*(i+1);for(let m=0;m<i;m++){let S=m+g,A=S,_=S+i+1,w=S+i+2,R=S+1;a.push(A,_,R),a.push(_,w,R)}}this.setIndex(a),this.setAttribute("position",new ft(l,3)),this.setAttribute("normal",new ft(c,3)),this.setAttribute("uv",new ft(u,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.innerRadius,e.outerRadius,e.thetaSegments,e.phiSegments,e.thetaStart,e.thetaLength)}};var es=class n extends Ot{constructor(e=1,t=32,i=16,s=0,r=Math.PI*2,o=0,a=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:e,widthSegments:t,heightSegments:i,phiStart:s,phiLength:r,thetaStart:o,thetaLength:a},t=Math.max(3,Math.floor(t)),i=Math.max(2,Math.floor(i));let l=Math.min(o+a,Math.PI),c=0,u=[],h=new F,p=new F,d=[],f=[],b=[],g=[];for(let m=0;m<=i;m++){let S=[],A=m/i,_=o+A*a,w=e*Math.cos(_),R=Math.sqrt(e*e-w*w),y=0;m===0&&o===0?y=.5/t:m===i&&l===Math.PI&&(y=-.5/t);for(let E=0;E<=t;E++){let L=E/t,C=s+L*r;h.x=-R*Math.cos(C),h.y=w,h.z=R*Math.sin(C),f.push(h.x,h.y,h.z),p.copy(h).normalize(),b.push(p.x,p.y,p.z),g.push(L+y,1-A),S.push(c++)}u.push(S)}for(let m=0;m<i;m++)for(let S=0;S<t;S++){let A=u[m][S+1],_=u[m][S],w=u[m+1][S],R=u[m+1][S+1];(m!==0||o>0)&&d.push(A,_,R),(m!==i-1||l<Math.PI)&&d.push(_,w,R)}this.setIndex(d),this.setAttribute("position",new ft(f,3)),this.setAttribute("normal",new ft(b,3)),this.setAttribute("uv",new ft(g,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.radius,e.widthSegments,e.heightSegments,e.phiStart,e.phiLength,e.thetaStart,e.thetaLength)}};function Ns(n){let e={};for(let t in n){e[t]={};for(let i in n[t]){let s=n[t][i];if(py(s))s.isRenderTargetTexture?(Ne("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),e[t][i]=null):e[t][i]=s.clone();else if(Array.isArray(s))if(py(s[0])){let r=[];for(let o=0,a=s.length;o<a;o++)r[o]=s[o].clone();e[t][i]=r}else e[t][i]=s.slice();else e[t][i]=s}}return e}function cn(n){let e={};for(let t=0;t<n.length;t++){let i=Ns(n[t]);for(let s in i)e[s]=i[s]}return e}function py(n){return n&&(n.isColor||n.isMatrix3||n.isMatrix4||n.isVector2||n.isVector3||n.isVector4||n.isTexture||n.isQuaternion)}function C_(n){let e=[];for(let t=0;t<n.length;t++)e.push(n[t].clone());return e}function Fh(n){let e=n.getRenderTarget();return e===null?n.outputColorSpace:e.isXRRenderTarget===!0?e.texture.colorSpace:je.workingColorSpace}var cb={clone:Ns,merge:cn},I_=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,N_=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,bi=class extends gi{constructor(e){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=I_,this.fragmentShader=N_,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,e!==void 0&&this.setValues(e)}copy(e){return super.copy(e),this.fragmentShader=e.fragmentShader,this.vertexShader=e.vertexShader,this.uniforms=Ns(e.uniforms),this.uniformsGroups=C_(e.uniformsGroups),this.defines=Object.assign({},e.defines),this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.fog=e.fog,this.lights=e.lights,this.clipping=e.clipping,this.extensions=Object.assign({},e.extensions),this.glslVersion=e.glslVersion,this.defaultAttributeValues=Object.assign({},e.defaultAttributeValues),this.index0AttributeName=e.index0AttributeName,this.uniformsNeedUpdate=e.uniformsNeedUpdate,this}toJSON(e){let t=super.toJSON(e);t.glslVersion=this.glslVersion,t.uniforms={};for(let s in this.uniforms){let o=this.uniforms[s].value;o&&o.isTexture?t.uniforms[s]={type:"t",value:o.toJSON(e).uuid}:o&&o.isColor?t.uniforms[s]={type:"c",value:o.getHex()}:o&&o.isVector2?t.uniforms[s]={type:"v2",value:o.toArray()}:o&&o.isVector3?t.uniforms[s]={type:"v3",value:o.toArray()}:o&&o.isVector4?t.uniforms[s]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?t.uniforms[s]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?t.uniforms[s]={type:"m4",value:o.toArray()}:t.uniforms[s]={value:o}}Object.keys(this.defines).length>0&&(t.defines=this.defines),t.vertexShader=this.vertexShader,t.fragmentShader=this.fragmentShader,t.lights=this.lights,t.clipping=this.clipping;let i={};for(let s in this.extensions)this.extensions[s]===!0&&(i[s]=!0);return Object.keys(i).length>0&&(t.extensions=i),t}fromJSON(e,t){if(super.fromJSON(e,t),e.uniforms!==void 0)for(let i in e.uniforms){let s=e.uniforms[i];switch(this.uniforms[i]={},s.type){case"t":this.uniforms[i].value=t[s.value]||null;break;case"c":this.uniforms[i].value=new We().setHex(s.value);break;case"v2":this.uniforms[i].value=new Be().fromArray(s.value);break;case"v3":this.uniforms[i].value=new F().fromArray(s.value);break;case"v4":this.uniforms[i].value=new mt().fromArray(s.value);break;case"m3":this.uniforms[i].value=new De().fromArray(s.value);break;case"m4":this.uniforms[i].value=new Ye().fromArray(s.value);break;default:this.uniforms[i].value=s.value}}if(e.defines!==void 0&&(this.defines=e.defines),e.vertexShader!==void 0&&(this.vertexShader=e.vertexShader),e.fragmentShader!==void 0&&(this.fragmentShader=e.fragmentShader),e.glslVersion!==void 0&&(this.glslVersion=e.glslVersion),e.extensions!==void 0)for(let i in e.extensions)this.extensions[i]=e.extensions[i];return e.lights!==void 0&&(this.lights=e.lights),e.clipping!==void 0&&(this.clipping=e.clipping),this}},Xl=class extends bi{constructor(e){super(e),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}},Do=class extends gi{constructor(e){super(),this.isMeshStandardMaterial=!0,this.type="MeshStandardMaterial",this.defines={STANDARD:""},this.color=new We(16777215),this.roughness=1,this.metalness=0,this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new We(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=ea,this.normalScale=new Be(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.roughnessMap=null,this.metalnessMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new mi,this.envMapIntensity=1,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.defines={STANDARD:""},this.color.copy(e.color),this.roughness=e.roughness,this.metalness=e.metalness,this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.emissive.copy(e.emissive),this.emissiveMap=e.emissiveMap,this.emissiveIntensity=e.emissiveIntensity,this.bumpMap=e.bumpMap,this.bumpScale=e.bumpScale,this.normalMap=e.normalMap,this.normalMapType=e.normalMapType,this.normalScale.copy(e.normalScale),this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.roughnessMap=e.roughnessMap,this.metalnessMap=e.metalnessMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.envMapIntensity=e.envMapIntensity,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.flatShading=e.flatShading,this.fog=e.fog,this}};var Di=class extends gi{constructor(e){super(),this.isMeshLambertMaterial=!0,this.type="MeshLambertMaterial",this.color=new We(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new We(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=ea,this.normalScale=new Be(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new mi,this.combine=rc,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.emissive.copy(e.emissive),this.emissiveMap=e.emissiveMap,this.emissiveIntensity=e.emissiveIntensity,this.bumpMap=e.bumpMap,this.bumpScale=e.bumpScale,this.normalMap=e.normalMap,this.normalMapType=e.normalMapType,this.normalScale.copy(e.normalScale),this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.envMapIntensity=e.envMapIntensity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.flatShading=e.flatShading,this.fog=e.fog,this}},Zl=class extends gi{constructor(e){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=Yy,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(e)}copy(e){return super.copy(e),this.depthPacking=e.depthPacking,this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this}},Hl=class extends gi{constructor(e){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(e)}copy(e){return super.copy(e),this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this}};function cr(n,e){return!n||n.constructor===e?n:typeof e.BYTES_PER_ELEMENT=="number"?new e(n):Array.prototype.slice.call(n)}function Al(n){return n!==void 0&&n.inTangents!==void 0&&n.outTangents!==void 0}var ts=class{constructor(e,t,i,s){this.parameterPositions=e,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new t.constructor(i),this.sampleValues=t,this.valueSize=i,this.settings=null,this.DefaultSettings_={}}evaluate(e){let t=this.parameterPositions,i=this._cachedIndex,s=t[i],r=t[i-1];n:{e:{let o;t:{i:if(!(e<s)){for(let a=i+2;;){if(s===void 0){if(e<r)break i;return i=t.length,this._cachedIndex=i,this.copySampleValue_(i-1)}if(i===a)break;if(r=s,s=t[++i],e<s)break e}o=t.length;break t}if(!(e>=r)){let a=t[1];e<a&&(i=2,r=a);for(let l=i-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(i===l)break;if(s=r,r=t[--i-1],e>=r)break e}o=i,i=0;break t}break n}for(;i<o;){let a=i+o>>>1;e<t[a]?o=a:i=a+1}if(s=t[i],r=t[i-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return i=t.length,this._cachedIndex=i,this.copySampleValue_(i-1)}this._cachedIndex=i,this.intervalChanged_(i,r,s)}return this.interpolate_(i,r,e,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(e){let t=this.resultBuffer,i=this.sampleValues,s=this.valueSize,r=e*s;for(let o=0;o!==s;++o)t[o]=i[r+o];return t}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},Yl=class extends ts{constructor(e,t,i,s){super(e,t,i,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:$d,endingEnd:$d}}intervalChanged_(e,t,i){let s=this.parameterPositions,r=e-2,o=e+1,a=s[r],l=s[o];if(a===void 0)switch(this.getSettings_().endingStart){case eh:r=e,a=2*t-i;break;case th:r=s.length-2,a=t+s[r]-s[r+1];break;default:r=e,a=i}if(l===void 0)switch(this.getSettings_().endingEnd){case eh:o=e,l=2*i-t;break;case th:o=1,l=i+s[1]-s[0];break;default:o=e-1,l=t}let c=(i-t)*.5,u=this.valueSize;this._weightPrev=c/(t-a),this._weightNext=c/(l-i),this._offsetPrev=r*u,this._offsetNext=o*u}interpolate_(e,t,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,u=this._offsetPrev,h=this._offsetNext,p=this._weightPrev,d=this._weightNext,f=(i-t)/(s-t),b=f*f,g=b*f,m=-p*g+2*p*b-p*f,S=(1+p)*g+(-1.5-2*p)*b+(-.5+p)*f+1,A=(-1-d)*g+(1.5+d)*b+.5*f,_=d*g-d*b;for(let w=0;w!==a;++w)r[w]=m*o[u+w]+S*o[c+w]+A*o[l+w]+_*o[h+w];return r}},Jl=class extends ts{constructor(e,t,i,s){super(e,t,i,s)}interpolate_(e,t,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,u=(i-t)/(s-t),h=1-u;for(let p=0;p!==a;++p)r[p]=o[c+p]*h+o[l+p]*u;return r}},Ql=class extends ts{constructor(e,t,i,s){super(e,t,i,s)}interpolate_(e){return this.copySampleValue_(e-1)}},Kl=class extends ts{interpolate_(e,t,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,u=this.inTangents,h=this.outTangents;if(!u||!h){let f=(i-t)/(s-t),b=1-f;for(let g=0;g!==a;++g)r[g]=o[c+g]*b+o[l+g]*f;return r}let p=a*2,d=e-1;for(let f=0;f!==a;++f){let b=o[c+f],g=o[l+f],m=d*p+f*2,S=h[m],A=h[m+1],_=e*p+f*2,w=u[_],R=u[_+1],y=L_(i,t,S,w,s);r[f]=ub(y,b,A,R,g)}return r}};function ub(n,e,t,i,s){let r=1-n;return r*r*r*e+3*r*r*n*t+3*r*n*n*i+n*n*n*s}function B_(n,e,t,i,s){let r=1-n;return 3*r*r*(t-e)+6*r*n*(i-t)+3*n*n*(s-i)}function L_(n,e,t,i,s){let r=(n-e)/(s-e);for(let o=0;o<8;o++){let a=ub(r,e,t,i,s)-n;if(Math.abs(a)<1e-10)break;let l=B_(r,e,t,i,s);if(Math.abs(l)<1e-10)break;r=Math.max(0,Math.min(1,r-a/l))}return r}var Ln=class{constructor(e,t,i,s){if(e===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(t===void 0||t.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+e);this.name=e,this.times=cr(t,this.TimeBufferType),this.values=cr(i,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(e){let t=e.constructor,i;if(t.toJSON!==this.toJSON)i=t.toJSON(e);else{i={name:e.name,times:cr(e.times,Array),values:cr(e.values,Array)};let s=e.getInterpolation();s!==e.DefaultInterpolation&&(i.interpolation=s),Al(e.settings)&&(i.settings={inTangents:cr(e.settings.inTangents,Array),outTangents:cr(e.settings.outTangents,Array)})}return i.type=e.ValueTypeName,i}InterpolantFactoryMethodDiscrete(e){return new Ql(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodLinear(e){return new Jl(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodSmooth(e){return new Yl(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodBezier(e){let t=new Kl(this.times,this.values,this.getValueSize(),e);return this.settings&&(t.inTangents=this.settings.inTangents,t.outTangents=this.settings.outTangents),t}setInterpolation(e){let t;switch(e){case bo:t=this.InterpolantFactoryMethodDiscrete;break;case Dl:t=this.InterpolantFactoryMethodLinear;break;case wl:t=this.InterpolantFactoryMethodSmooth;break;case jd:t=this.InterpolantFactoryMethodBezier;break}if(t===void 0){let i="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(e!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(i);return Ne("KeyframeTrack:",i),this}return this.createInterpolant=t,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return bo;case this.InterpolantFactoryMethodLinear:return Dl;case this.InterpolantFactoryMethodSmooth:return wl;case this.InterpolantFactoryMethodBezier:return jd}}getValueSize(){return this.values.length/this.times.length}shift(e){if(e!==0){let t=this.times;for(let i=0,s=t.length;i!==s;++i)t[i]+=e;Al(this.settings)&&(fy(this.settings.inTangents,e),fy(this.settings.outTangents,e))}return this}scale(e){if(e!==1){let t=this.times;for(let i=0,s=t.length;i!==s;++i)t[i]*=e;Al(this.settings)&&(my(this.settings.inTangents,e),my(this.settings.outTangents,e))}return this}trim(e,t){let i=this.times,s=i.length,r=0,o=s-1;for(;r!==s&&i[r]<e;)++r;for(;o!==-1&&i[o]>t;)--o;if(++o,r!==0||o!==s){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=i.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let e=!0,t=this.getValueSize();t-Math.floor(t)!==0&&(Pe("KeyframeTrack: Invalid value size in track.",this),e=!1);let i=this.times,s=this.values,r=i.length;r===0&&(Pe("KeyframeTrack: Track is empty.",this),e=!1);let o=null;for(let a=0;a!==r;a++){let l=i[a];if(typeof l=="number"&&isNaN(l)){Pe("KeyframeTrack: Time is not a valid number.",this,a,l),e=!1;break}if(o!==null&&o>l){Pe("KeyframeTrack: Out of order keys.",this,a,l,o),e=!1;break}o=l}if(s!==void 0&&YS(s))for(let a=0,l=s.length;a!==l;++a){let c=s[a];if(isNaN(c)){Pe("KeyframeTrack: Value is not a valid number.",this,a,c),e=!1;break}}return e}optimize(){let e=this.times.slice(),t=this.values.slice(),i=this.getValueSize(),s=this.getInterpolation()===wl,r=e.length-1,o=1;for(let a=1;a<r;++a){let l=!1,c=e[a],u=e[a+1];if(c!==u&&(a!==1||c!==e[0]))if(s)l=!0;else{let h=a*i,p=h-i,d=h+i;for(let f=0;f!==i;++f){let b=t[h+f];if(b!==t[p+f]||b!==t[d+f]){l=!0;break}}}if(l){if(a!==o){e[o]=e[a];let h=a*i,p=o*i;for(let d=0;d!==i;++d)t[p+d]=t[h+d]}++o}}if(r>0){e[o]=e[r];for(let a=r*i,l=o*i,c=0;c!==i;++c)t[l+c]=t[a+c];++o}return o!==e.length?(this.times=e.slice(0,o),this.values=t.slice(0,o*i)):(this.times=e,this.values=t),this}clone(){let e=this.times.slice(),t=this.values.slice(),i=this.constructor,s=new i(this.name,e,t);return s.createInterpolant=this.createInterpolant,Al(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function fy(n,e){for(let t=0,i=n.length;t!==i;t+=2)n[t]+=e}function my(n,e){for(let t=0,i=n.length;t!==i;t+=2)n[t]*=e}Ln.prototype.ValueTypeName="";Ln.prototype.TimeBufferType=Float32Array;Ln.prototype.ValueBufferType=Float32Array;Ln.prototype.DefaultInterpolation=Dl;var ns=class extends Ln{constructor(e,t,i){super(e,t,i)}};ns.prototype.ValueTypeName="bool";ns.prototype.ValueBufferType=Array;ns.prototype.DefaultInterpolation=bo;ns.prototype.InterpolantFactoryMethodLinear=void 0;ns.prototype.InterpolantFactoryMethodSmooth=void 0;var ql=class extends Ln{constructor(e,t,i,s){super(e,t,i,s)}};ql.prototype.ValueTypeName="color";var jl=class extends Ln{constructor(e,t,i,s){super(e,t,i,s)}};jl.prototype.ValueTypeName="number";var $l=class extends ts{constructor(e,t,i,s){super(e,t,i,s)}interpolate_(e,t,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=(i-t)/(s-t),c=e*a;for(let u=c+a;c!==u;c+=4)en.slerpFlat(r,0,o,c-a,o,c,l);return r}},Go=class extends Ln{constructor(e,t,i,s){super(e,t,i,s)}InterpolantFactoryMethodLinear(e){return new $l(this.times,this.values,this.getValueSize(),e)}};Go.prototype.ValueTypeName="quaternion";Go.prototype.InterpolantFactoryMethodSmooth=void 0;var is=class extends Ln{constructor(e,t,i){super(e,t,i)}};is.prototype.ValueTypeName="string";is.prototype.ValueBufferType=Array;is.prototype.DefaultInterpolation=bo;is.prototype.InterpolantFactoryMethodLinear=void 0;is.prototype.InterpolantFactoryMethodSmooth=void 0;var ec=class extends Ln{constructor(e,t,i,s){super(e,t,i,s)}};ec.prototype.ValueTypeName="vector";var tc=class{constructor(e,t,i){let s=this,r=!1,o=0,a=0,l,c=[];this.onStart=void 0,this.onLoad=e,this.onProgress=t,this.onError=i,this._abortController=null,this.itemStart=function(u){a++,r===!1&&s.onStart!==void 0&&s.onStart(u,o,a),r=!0},this.itemEnd=function(u){o++,s.onProgress!==void 0&&s.onProgress(u,o,a),o===a&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(u){s.onError!==void 0&&s.onError(u)},this.resolveURL=function(u){return u=u.normalize("NFC"),l?l(u):u},this.setURLModifier=function(u){return l=u,this},this.addHandler=function(u,h){return c.push(u,h),this},this.removeHandler=function(u){let h=c.indexOf(u);return h!==-1&&c.splice(h,2),this},this.getHandler=function(u){for(let h=0,p=c.length;h<p;h+=2){let d=c[h],f=c[h+1];if(d.global&&(d.lastIndex=0),d.test(u))return f}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},db=new tc,nc=class{constructor(e){this.manager=e!==void 0?e:db,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(e,t){let i=this;return new Promise(function(s,r){i.load(e,s,t,r)})}parse(){}setCrossOrigin(e){return this.crossOrigin=e,this}setWithCredentials(e){return this.withCredentials=e,this}setPath(e){return this.path=e,this}setResourcePath(e){return this.resourcePath=e,this}setRequestHeader(e){return this.requestHeader=e,this}setPriority(e){return this.priority=e,this}setCache(e){return this.cache=e,this}abort(){return this}};nc.DEFAULT_MATERIAL_NAME="__DEFAULT";var Vo=class extends Qt{static registerNode(e){this.prototype._lightNode=e}constructor(e,t=1){super(),this.isLight=!0,this.type="Light",this.color=new We(e),this.intensity=t}copy(e,t){return super.copy(e,t),this.color.copy(e.color),this.intensity=e.intensity,this}toJSON(e){let t=super.toJSON(e);return t.object.color=this.color.getHex(),t.object.intensity=this.intensity,t}},Oo=class extends Vo{constructor(e,t,i){super(e,i),this.isHemisphereLight=!0,this.type="HemisphereLight",this.position.copy(Qt.DEFAULT_UP),this.updateMatrix(),this.groundColor=new We(t)}copy(e,t){return super.copy(e,t),this.groundColor.copy(e.groundColor),this}toJSON(e){let t=super.toJSON(e);return t.object.groundColor=this.groundColor.getHex(),t}},Kd=new Ye,gy=new F,yy=new F,ic=class{constructor(e){this.camera=e,this.intensity=1,this.bias=0,this.biasNode=null,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new Be(512,512),this.mapType=Mn,this.map=null,this.mapPass=null,this.matrix=new Ye,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new $i,this._frameExtents=new Be(1,1),this._viewportCount=1,this._viewports=[new mt(0,0,1,1)]}getViewportCount(){return this._viewportCount}getCamera(){return this.camera}getFrustum(){return this._frustum}updateMatrices(e){let t=this.camera;gy.setFromMatrixPosition(e.matrixWorld),t.position.copy(gy),yy.setFromMatrixPosition(e.target.matrixWorld),t.lookAt(yy),t.updateMatrixWorld(),this._updateMatrix(t,this.matrix,this._frustum)}_updateMatrix(e,t,i,s){Kd.multiplyMatrices(e.projectionMatrix,e.matrixWorldInverse),i.setFromProjectionMatrix(Kd,e.coordinateSystem,e.reversedDepth);let r=this._frameExtents,o=s?s.z/r.x:1,a=s?s.w/r.y:1,l=s?s.x/r.x:0,c=s?s.y/r.y:0;e.coordinateSystem===mr||e.reversedDepth?t.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,1,0,0,0,0,1):t.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,.5,.5,0,0,0,1),t.multiply(Kd)}getViewport(e){return this._viewports[e]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(e){return this.camera=e.camera.clone(),this.intensity=e.intensity,this.bias=e.bias,this.radius=e.radius,this.autoUpdate=e.autoUpdate,this.needsUpdate=e.needsUpdate,this.normalBias=e.normalBias,this.blurSamples=e.blurSamples,this.mapSize.copy(e.mapSize),this.mapType=e.mapType,this.biasNode=e.biasNode,this}clone(){return new this.constructor().copy(this)}toJSON(){let e={};return e.intensity=this.intensity,e.bias=this.bias,e.normalBias=this.normalBias,e.radius=this.radius,e.blurSamples=this.blurSamples,e.mapSize=this.mapSize.toArray(),e.mapType=this.mapType,e.camera=this.camera.toJSON(!1).object,delete e.camera.matrix,e}},Ml=new F,Rl=new en,pi=new F,ko=class extends Qt{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new Ye,this.projectionMatrix=new Ye,this.projectionMatrixInverse=new Ye,this.coordinateSystem=zn,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(e,t){return super.copy(e,t),this.matrixWorldInverse.copy(e.matrixWorldInverse),this.projectionMatrix.copy(e.projectionMatrix),this.projectionMatrixInverse.copy(e.projectionMatrixInverse),this.coordinateSystem=e.coordinateSystem,this}getWorldDirection(e){return super.getWorldDirection(e).negate()}updateMatrixWorld(e){super.updateMatrixWorld(e),this.matrixWorld.decompose(Ml,Rl,pi),pi.x===1&&pi.y===1&&pi.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Ml,Rl,pi.set(1,1,1)).invert()}updateWorldMatrix(e,t,i=!1){super.updateWorldMatrix(e,t,i),this.matrixWorld.decompose(Ml,Rl,pi),pi.x===1&&pi.y===1&&pi.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Ml,Rl,pi.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},qi=new F,by=new Be,xy=new Be,mn=class extends ko{constructor(e=50,t=1,i=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=e,this.zoom=1,this.near=i,this.far=s,this.focus=10,this.aspect=t,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.fov=e.fov,this.zoom=e.zoom,this.near=e.near,this.far=e.far,this.focus=e.focus,this.aspect=e.aspect,this.view=e.view===null?null:Object.assign({},e.view),this.filmGauge=e.filmGauge,this.filmOffset=e.filmOffset,this}setFocalLength(e){let t=.5*this.getFilmHeight()/e;this.fov=yr*2*Math.atan(t),this.updateProjectionMatrix()}getFocalLength(){let e=Math.tan(go*.5*this.fov);return .5*this.getFilmHeight()/e}getEffectiveFOV(){return yr*2*Math.atan(Math.tan(go*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(e,t,i){qi.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),t.set(qi.x,qi.y).multiplyScalar(-e/qi.z),qi.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),i.set(qi.x,qi.y).multiplyScalar(-e/qi.z)}getViewSize(e,t){return this.getViewBounds(e,by,xy),t.subVectors(xy,by)}setViewOffset(e,t,i,s,r,o){this.aspect=e/t,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=i,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=this.near,t=e*Math.tan(go*.5*this.fov)/this.zoom,i=2*t,s=this.aspect*i,r=-.5*s,o=this.view;if(this.view!==null&&this.view.enabled){let l=o.fullWidth,c=o.fullHeight;r+=o.offsetX*s/l,t-=o.offsetY*i/c,s*=o.width/l,i*=o.height/c}let a=this.filmOffset;a!==0&&(r+=e*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,t,t-i,e,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.fov=this.fov,t.object.zoom=this.zoom,t.object.near=this.near,t.object.far=this.far,t.object.focus=this.focus,t.object.aspect=this.aspect,this.view!==null&&(t.object.view=Object.assign({},this.view)),t.object.filmGauge=this.filmGauge,t.object.filmOffset=this.filmOffset,t}};var Wo=class extends ko{constructor(e=-1,t=1,i=1,s=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=e,this.right=t,this.top=i,this.bottom=s,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.left=e.left,this.right=e.right,this.top=e.top,this.bottom=e.bottom,this.near=e.near,this.far=e.far,this.zoom=e.zoom,this.view=e.view===null?null:Object.assign({},e.view),this}setViewOffset(e,t,i,s,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=i,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=(this.right-this.left)/(2*this.zoom),t=(this.top-this.bottom)/(2*this.zoom),i=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=i-e,o=i+e,a=s+t,l=s-t;if(this.view!==null&&this.view.enabled){let c=(this.right-this.left)/this.view.fullWidth/this.zoom,u=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,o=r+c*this.view.width,a-=u*this.view.offsetY,l=a-u*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,l,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.zoom=this.zoom,t.object.left=this.left,t.object.right=this.right,t.object.top=this.top,t.object.bottom=this.bottom,t.object.near=this.near,t.object.far=this.far,this.view!==null&&(t.object.view=Object.assign({},this.view)),t}},nh=class extends ic{constructor(){super(new Wo(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}},zo=class extends Vo{constructor(e,t){super(e,t),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(Qt.DEFAULT_UP),this.updateMatrix(),this.target=new Qt,this.shadow=new nh}dispose(){super.dispose(),this.shadow.dispose()}copy(e){return super.copy(e),this.target=e.target.clone(),this.shadow=e.shadow.clone(),this}toJSON(e){let t=super.toJSON(e);return t.object.shadow=this.shadow.toJSON(),t.object.target=this.target.uuid,t}};var ur=-90,dr=1,Er=class extends Qt{constructor(e,t,i){super(),this.type="CubeCamera",this.renderTarget=i,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new mn(ur,dr,e,t);s.layers=this.layers,this.add(s);let r=new mn(ur,dr,e,t);r.layers=this.layers,this.add(r);let o=new mn(ur,dr,e,t);o.layers=this.layers,this.add(o);let a=new mn(ur,dr,e,t);a.layers=this.layers,this.add(a);let l=new mn(ur,dr,e,t);l.layers=this.layers,this.add(l);let c=new mn(ur,dr,e,t);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){let e=this.coordinateSystem,t=this.children.concat(),[i,s,r,o,a,l]=t;for(let c of t)this.remove(c);if(e===zn)i.up.set(0,1,0),i.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(e===mr)i.up.set(0,-1,0),i.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+e);for(let c of t)this.add(c),c.updateMatrixWorld()}update(e,t){this.parent===null&&this.updateMatrixWorld();let{renderTarget:i,activeMipmapLevel:s}=this;this.coordinateSystem!==e.coordinateSystem&&(this.coordinateSystem=e.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,l,c,u]=this.children,h=e.getRenderTarget(),p=e.getActiveCubeFace(),d=e.getActiveMipmapLevel(),f=e.xr.enabled;e.xr.enabled=!1;let b=i.texture.mipmapsAutoUpdate;i.texture.mipmapsAutoUpdate=!1;let g=!1;e.isWebGLRenderer===!0?g=e.state.buffers.depth.getReversed():g=e.reversedDepthBuffer,e.setRenderTarget(i,0,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,r),e.setRenderTarget(i,1,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,o),e.setRenderTarget(i,2,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,a),e.setRenderTarget(i,3,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,l),e.setRenderTarget(i,4,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,c),i.texture.mipmapsAutoUpdate=b,e.setRenderTarget(i,5,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,u),e.setRenderTarget(h,p,d),e.xr.enabled=f,i.texture.needsPMREMUpdate=!0}},sc=class extends mn{constructor(e=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=e,this.perCameraFrustumCulled=!1}};var Uh="\\[\\]\\.:\\/",F_=new RegExp("["+Uh+"]","g"),Ph="[^"+Uh+"]",U_="[^"+Uh.replace("\\.","")+"]",P_=/((?:WC+[\/:])*)/.source.replace("WC",Ph),D_=/(WCOD+)?/.source.replace("WCOD",U_),G_=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",Ph),V_=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",Ph),O_=new RegExp("^"+P_+D_+G_+V_+"$"),k_=["material","materials","bones","map"],ih=class{constructor(e,t,i){let s=i||St.parseTrackName(t);this._targetGroup=e,this._bindings=e.subscribe_(t,s)}getValue(e,t){this.bind();let i=this._targetGroup.nCachedObjects_,s=this._bindings[i];s!==void 0&&s.getValue(e,t)}setValue(e,t){let i=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=i.length;s!==r;++s)i[s].setValue(e,t)}bind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,i=e.length;t!==i;++t)e[t].bind()}unbind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,i=e.length;t!==i;++t)e[t].unbind()}},St=class n{constructor(e,t,i){this.path=t,this.parsedPath=i||n.parseTrackName(t),this.node=n.findNode(e,this.parsedPath.nodeName),this.rootNode=e,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(e,t,i){return e&&e.isAnimationObjectGroup?new n.Composite(e,t,i):new n(e,t,i)}static sanitizeNodeName(e){return e.replace(/\s/g,"_").replace(F_,"")}static parseTrackName(e){let t=O_.exec(e);if(t===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+e);let i={nodeName:t[2],objectName:t[3],objectIndex:t[4],propertyName:t[5],propertyIndex:t[6]},s=i.nodeName&&i.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=i.nodeName.substring(s+1);k_.indexOf(r)!==-1&&(i.nodeName=i.nodeName.substring(0,s),i.objectName=r)}if(i.propertyName===null||i.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+e);return i}static findNode(e,t){if(t===void 0||t===""||t==="."||t===-1||t===e.name||t===e.uuid)return e;if(e.skeleton){let i=e.skeleton.getBoneByName(t);if(i!==void 0)return i}if(e.children){let i=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===t||a.uuid===t)return a;let l=i(a.children);if(l)return l}return null},s=i(e.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(e,t){e[t]=this.targetObject[this.propertyName]}_getValue_array(e,t){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)e[t++]=i[s]}_getValue_arrayElement(e,t){e[t]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(e,t){this.resolvedProperty.toArray(e,t)}_setValue_direct(e,t){this.targetObject[this.propertyName]=e[t]}_setValue_direct_setNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(e,t){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=e[t++]}_setValue_array_setNeedsUpdate(e,t){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=e[t++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(e,t){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=e[t++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(e,t){this.resolvedProperty[this.propertyIndex]=e[t]}_setValue_arrayElement_setNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(e,t){this.resolvedProperty.fromArray(e,t)}_setValue_fromArray_setNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(e,t){this.bind(),this.getValue(e,t)}_setValue_unbound(e,t){this.bind(),this.setValue(e,t)}bind(){let e=this.node,t=this.parsedPath,i=t.objectName,s=t.propertyName,r=t.propertyIndex;if(e||(e=n.findNode(this.rootNode,t.nodeName),this.node=e),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!e){Ne("PropertyBinding: No target node found for track: "+this.path+".");return}if(i){let c=t.objectIndex;switch(i){case"materials":if(!e.material){Pe("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.materials){Pe("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}e=e.material.materials;break;case"bones":if(!e.skeleton){Pe("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}e=e.skeleton.bones;for(let u=0;u<e.length;u++)if(e[u].name===c){c=u;break}break;case"map":if("map"in e){e=e.map;break}if(!e.material){Pe("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.map){Pe("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}e=e.material.map;break;default:if(e[i]===void 0){Pe("PropertyBinding: Can not bind to objectName of node undefined.",this);return}e=e[i]}if(c!==void 0){if(e[c]===void 0){Pe("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,e);return}e=e[c]}}let o=e[s];if(o===void 0){let c=t.nodeName;Pe("PropertyBinding: Trying to update property for track: "+c+"."+s+" but it wasn't found.",e);return}let a=this.Versioning.None;this.targetObject=e,e.isMaterial===!0?a=this.Versioning.NeedsUpdate:e.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let l=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!e.geometry){Pe("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!e.geometry.morphAttributes){Pe("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}e.morphTargetDictionary[r]!==void 0&&(r=e.morphTargetDictionary[r])}l=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(l=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(l=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=s;this.getValue=this.GetterByBindingType[l],this.setValue=this.SetterByBindingTypeAndVersioning[l][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};St.Composite=ih;St.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};St.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};St.prototype.GetterByBindingType=[St.prototype._getValue_direct,St.prototype._getValue_array,St.prototype._getValue_arrayElement,St.prototype._getValue_toArray];St.prototype.SetterByBindingTypeAndVersioning=[[St.prototype._setValue_direct,St.prototype._setValue_direct_setNeedsUpdate,St.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[St.prototype._setValue_array,St.prototype._setValue_array_setNeedsUpdate,St.prototype._setValue_array_setMatrixWorldNeedsUpdate],[St.prototype._setValue_arrayElement,St.prototype._setValue_arrayElement_setNeedsUpdate,St.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[St.prototype._setValue_fromArray,St.prototype._setValue_fromArray_setNeedsUpdate,St.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var bF=new Float32Array(1);var vy=new Ye,Xo=class{constructor(e,t,i=0,s=1/0){this.ray=new oi(e,t),this.near=i,this.far=s,this.camera=null,this.layers=new xr,this.params={Mesh:{},Line:{threshold:1},LOD:{},Points:{threshold:1},Sprite:{}}}set(e,t){this.ray.set(e,t)}setFromCamera(e,t){t.isPerspectiveCamera?(this.ray.origin.setFromMatrixPosition(t.matrixWorld),this.ray.direction.set(e.x,e.y,.5).unproject(t).sub(this.ray.origin).normalize(),this.camera=t):t.isOrthographicCamera?(this.ray.origin.set(e.x,e.y,t.projectionMatrix.elements[14]).unproject(t),this.ray.direction.set(0,0,-1).transformDirection(t.matrixWorld),this.camera=t):Pe("Raycaster: Unsupported camera type: "+t.type)}setFromXRController(e){return vy.identity().extractRotation(e.matrixWorld),this.ray.origin.setFromMatrixPosition(e.matrixWorld),this.ray.direction.set(0,0,-1).applyMatrix4(vy),this}intersectObject(e,t=!0,i=[]){return sh(e,this,i,t),i.sort(Sy),i}intersectObjects(e,t=!0,i=[]){for(let s=0,r=e.length;s<r;s++)sh(e[s],this,i,t);return i.sort(Sy),i}};function Sy(n,e){return n.distance-e.distance}function sh(n,e,t,i){let s=!0;if(n.layers.test(e.layers)&&n.raycast(e,t)===!1&&(s=!1),s===!0&&i===!0){let r=n.children;for(let o=0,a=r.length;o<a;o++)sh(r[o],e,t,!0)}}var Ar=class{constructor(e=1,t=0,i=0){this.radius=e,this.phi=t,this.theta=i}set(e,t,i){return this.radius=e,this.phi=t,this.theta=i,this}copy(e){return this.radius=e.radius,this.phi=e.phi,this.theta=e.theta,this}makeSafe(){return this.phi=Je(this.phi,1e-6,Math.PI-1e-6),this}setFromVector3(e){return this.setFromCartesianCoords(e.x,e.y,e.z)}setFromCartesianCoords(e,t,i){return this.radius=Math.sqrt(e*e+t*t+i*i),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(e,i),this.phi=Math.acos(Je(t/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}};var rh=class{static{this.prototype.isMatrix2=!0}constructor(e,t,i,s){this.elements=[1,0,0,1],e!==void 0&&this.set(e,t,i,s)}identity(){return this.set(1,0,0,1),this}fromArray(e,t=0){for(let i=0;i<4;i++)this.elements[i]=e[i+t];return this}set(e,t,i,s){let r=this.elements;return r[0]=e,r[2]=t,r[1]=i,r[3]=s,this}};var Zo=class extends ri{constructor(e,t=null){super(),this.object=e,this.domElement=t,this.enabled=!0,this.state=-1,this.keys={},this.mouseButtons={LEFT:null,MIDDLE:null,RIGHT:null},this.touches={ONE:null,TWO:null}}connect(e){this.domElement!==null&&this.disconnect(),this.domElement=e}disconnect(){}dispose(){}update(){}};function Dh(n,e,t,i){let s=W_(i);switch(t){case Eh:return n*e;case Mh:return n*e/s.components*s.byteLength;case hc:return n*e/s.components*s.byteLength;case os:return n*e*2/s.components*s.byteLength;case pc:return n*e*2/s.components*s.byteLength;case Ah:return n*e*3/s.components*s.byteLength;case Hn:return n*e*4/s.components*s.byteLength;case fc:return n*e*4/s.components*s.byteLength;case Jo:case Qo:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*8;case Ko:case qo:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*16;case gc:case bc:return Math.max(n,16)*Math.max(e,8)/4;case mc:case yc:return Math.max(n,8)*Math.max(e,8)/2;case xc:case vc:case _c:case Ec:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*8;case Sc:case jo:case Ac:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*16;case Mc:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*16;case Rc:return Math.floor((n+4)/5)*Math.floor((e+3)/4)*16;case wc:return Math.floor((n+4)/5)*Math.floor((e+4)/5)*16;case Tc:return Math.floor((n+5)/6)*Math.floor((e+4)/5)*16;case Cc:return Math.floor((n+5)/6)*Math.floor((e+5)/6)*16;case Ic:return Math.floor((n+7)/8)*Math.floor((e+4)/5)*16;case Nc:return Math.floor((n+7)/8)*Math.floor((e+5)/6)*16;case Bc:return Math.floor((n+7)/8)*Math.floor((e+7)/8)*16;case Lc:return Math.floor((n+9)/10)*Math.floor((e+4)/5)*16;case Fc:return Math.floor((n+9)/10)*Math.floor((e+5)/6)*16;case Uc:return Math.floor((n+9)/10)*Math.floor((e+7)/8)*16;case Pc:return Math.floor((n+9)/10)*Math.floor((e+9)/10)*16;case Dc:return Math.floor((n+11)/12)*Math.floor((e+9)/10)*16;case Gc:return Math.floor((n+11)/12)*Math.floor((e+11)/12)*16;case Vc:case Oc:case kc:return Math.ceil(n/4)*Math.ceil(e/4)*16;case Wc:case zc:return Math.ceil(n/4)*Math.ceil(e/4)*8;case $o:case Xc:return Math.ceil(n/4)*Math.ceil(e/4)*16}throw new Error(`Unable to determine texture byte length for ${t} format.`)}function W_(n){switch(n){case Mn:case xh:return{byteLength:1,components:1};case Tr:case vh:case ui:return{byteLength:2,components:1};case uc:case dc:return{byteLength:2,components:4};case ci:case cc:case Zn:return{byteLength:4,components:1};case Sh:case _h:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${n}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?Ne("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function Lb(){let n=null,e=!1,t=null,i=null;function s(r,o){i=n.requestAnimationFrame(s),t(r,o)}return{start:function(){e!==!0&&t!==null&&n!==null&&(i=n.requestAnimationFrame(s),e=!0)},stop:function(){n!==null&&n.cancelAnimationFrame(i),e=!1},setAnimationLoop:function(r){t=r},setContext:function(r){n=r}}}function X_(n){let e=new WeakMap;function t(a,l){let c=a.array,u=a.usage,h=c.byteLength,p=n.createBuffer();n.bindBuffer(l,p),n.bufferData(l,c,u),a.onUploadCallback();let d;if(c instanceof Float32Array)d=n.FLOAT;else if(typeof Float16Array<"u"&&c instanceof Float16Array)d=n.HALF_FLOAT;else if(c instanceof Uint16Array)a.isFloat16BufferAttribute?d=n.HALF_FLOAT:d=n.UNSIGNED_SHORT;else if(c instanceof Int16Array)d=n.SHORT;else if(c instanceof Uint32Array)d=n.UNSIGNED_INT;else if(c instanceof Int32Array)d=n.INT;else if(c instanceof Int8Array)d=n.BYTE;else if(c instanceof Uint8Array)d=n.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)d=n.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:p,type:d,bytesPerElement:c.BYTES_PER_ELEMENT,version:a.version,size:h}}function i(a,l,c){let u=l.array,h=l.updateRanges;if(n.bindBuffer(c,a),h.length===0)n.bufferSubData(c,0,u);else{h.sort((d,f)=>d.start-f.start);let p=0;for(let d=1;d<h.length;d++){let f=h[p],b=h[d];b.start<=f.start+f.count+1?f.count=Math.max(f.count,b.start+b.count-f.start):(++p,h[p]=b)}h.length=p+1;for(let d=0,f=h.length;d<f;d++){let b=h[d];n.bufferSubData(c,b.start*u.BYTES_PER_ELEMENT,u,b.start,b.count)}l.clearUpdateRanges()}l.onUploadCallback()}function s(a){return a.isInterleavedBufferAttribute&&(a=a.data),e.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let l=e.get(a);l&&(n.deleteBuffer(l.buffer),e.delete(a))}function o(a,l){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let u=e.get(a);(!u||u.version<a.version)&&e.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let c=e.get(a);if(c===void 0)e.set(a,t(a,l));else if(c.version<a.version){if(c.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");i(c.buffer,a,l),c.version=a.version}}return{get:s,remove:r,update:o}}var Z_=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,H_=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,Y_=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,J_=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,Q_=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,K_=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,q_=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,j_=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,$_=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec4 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 );
	}
#endif`,eE=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,tE=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,nE=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,iE=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,sE=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,rE=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,oE=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,aE=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,lE=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,cE=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,uE=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,dE=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,hE=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,pE=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec4( 1.0 );
#endif
#ifdef USE_COLOR_ALPHA
	vColor *= color;
#elif defined( USE_COLOR )
	vColor.rgb *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.rgb *= instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
	vColor *= getBatchingColor( getIndirectIndex( gl_DrawID ) );
#endif`,fE=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix( in vec3 normal, in mat4 viewMatrix ) {
	return normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );
}
vec3 transformDirectionByInverseViewMatrix( in vec3 dir, in mat4 viewMatrix ) {
	return normalize( ( vec4( dir, 0.0 ) * viewMatrix ).xyz );
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,mE=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
#endif`,gE=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,yE=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,bE=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,xE=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,vE="gl_FragColor = linearToOutputTexel( gl_FragColor );",SE=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,_E=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * reflectVec );
		#ifdef ENVMAP_BLENDING_MULTIPLY
			outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_MIX )
			outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_ADD )
			outgoingLight += envColor.xyz * specularStrength * reflectivity;
		#endif
	#endif
#endif`,EE=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,AE=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,ME=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,RE=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,wE=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,TE=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,CE=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,IE=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,NE=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,BE=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,LE=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,FE=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,UE=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_SUN_LIGHTS > 0
	struct SunLight {
		vec3 direction;
		vec3 color;
	};
	uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
	void getSunLightInfo( const in SunLight sunLight, out IncidentLight light ) {
		light.color = sunLight.color;
		light.direction = sunLight.direction;
		light.visible = true;
	}
#endif
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif
#include <lightprobes_pars_fragment>`,PE=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * worldNormal, ENVMAP_MAX_LOD );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, pow4( roughness ) ) );
			reflectVec = transformDirectionByInverseViewMatrix( reflectVec, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * reflectVec, roughnessToMip( roughness ) );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_RETROREFLECTION
		vec3 getIBLRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 retroVec = normalize( mix( viewDir, normal, pow4( roughness ) ) );
				retroVec = transformDirectionByInverseViewMatrix( retroVec, viewMatrix );
				vec4 envMapColor = textureLod( envMap, envMapRotation * retroVec, roughnessToMip( roughness ) );
				return envMapColor.rgb * envMapIntensity;
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
		#ifdef USE_RETROREFLECTION
			vec3 getIBLAnisotropyRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
				#ifdef ENVMAP_TYPE_PMREM
					vec3 bentNormal = cross( bitangent, viewDir );
					bentNormal = normalize( cross( bentNormal, bitangent ) );
					bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
					return getIBLRetroRadiance( viewDir, bentNormal, roughness );
				#else
					return vec3( 0.0 );
				#endif
			}
		#endif
	#endif
#endif`,DE=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,GE=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,VE=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,OE=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,kE=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.diffuseContribution = diffuseColor.rgb * ( 1.0 - metalnessFactor );
material.metalness = metalnessFactor;
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.045 );
material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef USE_DIFFUSE_ROUGHNESS
	float diffuseRoughnessFactor = diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		diffuseRoughnessFactor *= texture2D( diffuseRoughnessMap, vDiffuseRoughnessMapUv ).r;
	#endif
	material.diffuseRoughness = saturate( diffuseRoughnessFactor );
#endif
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor;
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = vec3( 0.04 );
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.045 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_RETROREFLECTION
	material.retroreflectivity = retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.0001, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,WE=`uniform sampler2D dfgLUT;
struct PhysicalMaterial {
	vec3 diffuseColor;
	vec3 diffuseContribution;
	vec3 specularColor;
	vec3 specularColorBlended;
	float roughness;
	float metalness;
	float specularF90;
	float dispersion;
	vec2 dfg;
	vec3 multiScatteringCompensation;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float diffuseRoughness;
	#endif
	#ifdef USE_RETROREFLECTION
		float retroreflectivity;
	#endif
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0Dielectric;
		vec3 iridescenceF0Metallic;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
#ifdef USE_DIFFUSE_ROUGHNESS
	const float EON_EPSILON = 1e-7;
	float FON_DirectionalAlbedo( const in float mu, const in float roughness, const in float A ) {
		float muComp = 1.0 - mu;
		float gOverPi = muComp * ( 0.0571085289 + muComp * ( 0.491881867 + muComp * ( - 0.332181442 + muComp * 0.0714429953 ) ) );
		return A * ( 1.0 + roughness * gOverPi );
	}
	vec3 BRDF_EON( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 diffuseColor, const in float roughness ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return BRDF_Lambert( rho );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float s = dot( lightDir, viewDir ) - dotNL * dotNV;
		float sOverT = ( s > 0.0 ) ? s / max( max( dotNL, dotNV ), EON_EPSILON ) : s;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		vec3 singleScatter = rho * RECIPROCAL_PI * A * ( 1.0 + roughness * sOverT );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		float albedoV = FON_DirectionalAlbedo( dotNV, roughness, A );
		float albedoL = FON_DirectionalAlbedo( dotNL, roughness, A );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		vec3 multiScatter = rhoMultiScatter * RECIPROCAL_PI
			* max( EON_EPSILON, 1.0 - albedoV )
			* max( EON_EPSILON, 1.0 - albedoL )
			/ max( EON_EPSILON, 1.0 - averageAlbedo );
		return singleScatter + multiScatter;
	}
	vec3 EON_DirectionalAlbedo( const in vec3 diffuseColor, const in float roughness, const in float dotNV ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return rho;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		float directionalAlbedo = FON_DirectionalAlbedo( dotNV, roughness, A );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		return rho * directionalAlbedo + rhoMultiScatter * ( 1.0 - directionalAlbedo );
	}
#endif
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		return 0.5 / max( gv + gl, EPSILON );
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = max( material.clearcoatRoughness, 0.045 );
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColorBlended;
	float f90 = material.specularF90;
	float roughness = max( material.roughness, 0.045 );
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float alphaT = max( material.alphaT, alpha );
		float V = V_GGX_SmithCorrelated_Anisotropic( alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transpose( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float rInv = 1.0 / ( roughness + 0.1 );
	float a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * rInv;
	float b = -0.6014 + 0.5538 * roughness - 0.4670 * r2 - 0.1255 * rInv;
	float DG = exp( a * dotNV + b );
	return saturate( DG );
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	vec2 fab = texture2D( dfgLUT, vec2( roughness, dotNV ) ).rg;
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec2 fab, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec2 fab, const in vec3 specularColor, const in float specularF90, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColorBlended * t2.x + ( material.specularF90 - material.specularColorBlended ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseContribution * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
		#ifdef USE_CLEARCOAT
			vec3 Ncc = geometryClearcoatNormal;
			vec2 uvClearcoat = LTC_Uv( Ncc, viewDir, material.clearcoatRoughness );
			vec4 t1Clearcoat = texture2D( ltc_1, uvClearcoat );
			vec4 t2Clearcoat = texture2D( ltc_2, uvClearcoat );
			mat3 mInvClearcoat = mat3(
				vec3( t1Clearcoat.x, 0, t1Clearcoat.y ),
				vec3(             0, 1,             0 ),
				vec3( t1Clearcoat.z, 0, t1Clearcoat.w )
			);
			vec3 fresnelClearcoat = material.clearcoatF0 * t2Clearcoat.x + ( material.clearcoatF90 - material.clearcoatF0 ) * t2Clearcoat.y;
			clearcoatSpecularDirect += lightColor * fresnelClearcoat * LTC_Evaluate( Ncc, viewDir, position, mInvClearcoat, rectCoords );
		#endif
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
 
 		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
 
 		float sheenAlbedoV = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
 		float sheenAlbedoL = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
 
 		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * max( sheenAlbedoV, sheenAlbedoL );
 
 		irradiance *= sheenEnergyComp;
 
 	#endif
	vec3 specularBRDF = BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	#ifdef USE_RETROREFLECTION
		vec3 retroViewDir = reflect( - geometryViewDir, geometryNormal );
		vec3 retroSpecularBRDF = BRDF_GGX( directLight.direction, retroViewDir, geometryNormal, material );
		specularBRDF = mix( specularBRDF, retroSpecularBRDF, saturate( material.retroreflectivity ) );
	#endif
	reflectedLight.directSpecular += irradiance * specularBRDF * material.multiScatteringCompensation;
	vec3 halfDir = normalize( directLight.direction + geometryViewDir );
	float dotVH = saturate( dot( geometryViewDir, halfDir ) );
	vec3 F = F_Schlick( material.specularColor, material.specularF90, dotVH );
	#ifdef USE_RETROREFLECTION
		vec3 retroHalfDir = normalize( directLight.direction + retroViewDir );
		float dotRetroVH = saturate( dot( retroViewDir, retroHalfDir ) );
		vec3 retroF = F_Schlick( material.specularColor, material.specularF90, dotRetroVH );
		F = mix( F, retroF, saturate( material.retroreflectivity ) );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		vec3 diffuseBRDF = BRDF_EON( directLight.direction, geometryViewDir, geometryNormal, material.diffuseColor, material.diffuseRoughness ) * ( 1.0 - material.metalness );
	#else
		vec3 diffuseBRDF = BRDF_Lambert( material.diffuseContribution );
	#endif
	reflectedLight.directDiffuse += irradiance * diffuseBRDF * ( 1.0 - F );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScattering, multiScattering );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScattering, multiScattering );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuseAlbedo = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness );
		vec3 diffuse = irradiance * RECIPROCAL_PI * diffuseAlbedo * ( 1.0 - singleScattering - multiScattering );
	#else
		vec3 diffuse = irradiance * BRDF_Lambert( material.diffuseContribution ) * ( 1.0 - singleScattering - multiScattering );
	#endif
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		sheenSpecularIndirect += irradiance * material.sheenColor * sheenAlbedo * RECIPROCAL_PI;
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		diffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectDiffuse += diffuse;
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness ) * RECIPROCAL_PI;
 	#endif
	vec3 singleScatteringDielectric = vec3( 0.0 );
	vec3 multiScatteringDielectric = vec3( 0.0 );
	vec3 singleScatteringMetallic = vec3( 0.0 );
	vec3 multiScatteringMetallic = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscatteringIridescence( material.dfg, material.diffuseColor, material.specularF90, material.iridescence, material.iridescenceF0Metallic, singleScatteringMetallic, multiScatteringMetallic );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, singleScatteringMetallic, multiScatteringMetallic );
	#endif
	vec3 singleScattering = mix( singleScatteringDielectric, singleScatteringMetallic, material.metalness );
	vec3 multiScattering = mix( multiScatteringDielectric, multiScatteringMetallic, material.metalness );
	vec3 totalScatteringDielectric = singleScatteringDielectric + multiScatteringDielectric;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuse = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness ) * ( 1.0 - totalScatteringDielectric );
	#else
		vec3 diffuse = material.diffuseContribution * ( 1.0 - totalScatteringDielectric );
	#endif
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	vec3 indirectSpecular = radiance * singleScattering;
	indirectSpecular += multiScattering * cosineWeightedIrradiance;
	vec3 indirectDiffuse = diffuse * cosineWeightedIrradiance;
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		indirectSpecular *= sheenEnergyComp;
		indirectDiffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectSpecular += indirectSpecular;
	reflectedLight.indirectDiffuse += indirectDiffuse;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,zE=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		vec3 iridescenceFresnelDielectric = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		vec3 iridescenceFresnelMetallic = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.diffuseColor );
		material.iridescenceFresnel = mix( iridescenceFresnelDielectric, iridescenceFresnelMetallic, material.metalness );
		material.iridescenceF0Dielectric = Schlick_to_F0( iridescenceFresnelDielectric, 1.0, dotNVi );
		material.iridescenceF0Metallic = Schlick_to_F0( iridescenceFresnelMetallic, 1.0, dotNVi );
	}
#endif
#ifdef STANDARD
	float dotNVms = saturate( dot( geometryNormal, geometryViewDir ) );
	material.dfg = texture2D( dfgLUT, vec2( material.roughness, dotNVms ) ).rg;
	#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
		float EssMs = material.dfg.x + material.dfg.y;
		material.multiScatteringCompensation = 1.0 + material.specularColorBlended * ( 1.0 / EssMs - 1.0 );
	#endif
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
	SunLight sunLight;
	#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHTS; i ++ ) {
		sunLight = sunLights[ i ];
		getSunLightInfo( sunLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
		sunLightShadow = sunLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getSunShadow( sunShadowMap[ i ], sunLightShadow, UNROLLED_LOOP_INDEX ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_LIGHT_PROBE_GRIDS > 0
		vec3 probeWorldPos = ( ( vec4( geometryPosition, 1.0 ) - viewMatrix[ 3 ] ) * viewMatrix ).xyz;
		vec3 probeWorldNormal = transformNormalByInverseViewMatrix( geometryNormal, viewMatrix );
		int probeGrid = - 1;
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( isInsideLightProbeGrid( probeWorldPos, probeWorldNormal, probesMin[ i ], probesMax[ i ], probesResolution[ i ] ) ) probeGrid = UNROLLED_LOOP_INDEX;
		}
		#pragma unroll_loop_end
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( probeGrid == UNROLLED_LOOP_INDEX ) irradiance += getLightProbeGridIrradiance( probesSH[ i ], probesMin[ i ], probesMax[ i ], probesResolution[ i ], probeWorldPos, probeWorldNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,XE=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
		#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
			iblIrradiance += getIBLIrradiance( geometryNormal );
		#endif
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		vec3 iblRadiance = getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		vec3 iblRadiance = getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_RETROREFLECTION
		#ifdef USE_ANISOTROPY
			vec3 retroIBLRadiance = getIBLAnisotropyRetroRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
		#else
			vec3 retroIBLRadiance = getIBLRetroRadiance( geometryViewDir, geometryNormal, material.roughness );
		#endif
		iblRadiance = mix( iblRadiance, retroIBLRadiance, saturate( material.retroreflectivity ) );
	#endif
	radiance += iblRadiance;
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,ZE=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,HE=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {
	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );
}
vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {
	vec3 res = probesResolution;
	vec3 gridRange = probesMax - probesMin;
	vec3 probeSpacing = gridRange / res;
	vec3 samplePos = worldPos + worldNormal * probeSpacing * 0.5;
	vec3 uvw = clamp( ( samplePos - probesMin ) / gridRange, 0.5 / res, 1.0 - 0.5 / res );
	float nz          = res.z;
	float paddedSlices = nz + 2.0;
	float atlasDepth  = 7.0 * paddedSlices;
	float uvZBase     = uvw.z * nz + 1.0;
	vec4 s0 = texture( probesSH, vec3( uvw.xy, ( uvZBase                       ) / atlasDepth ) );
	vec4 s1 = texture( probesSH, vec3( uvw.xy, ( uvZBase +       paddedSlices   ) / atlasDepth ) );
	vec4 s2 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 2.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s3 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 3.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s4 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 4.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s5 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 5.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s6 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 6.0 * paddedSlices   ) / atlasDepth ) );
	vec3 c0 = s0.xyz;
	vec3 c1 = vec3( s0.w, s1.xy );
	vec3 c2 = vec3( s1.zw, s2.x );
	vec3 c3 = s2.yzw;
	vec3 c4 = s3.xyz;
	vec3 c5 = vec3( s3.w, s4.xy );
	vec3 c6 = vec3( s4.zw, s5.x );
	vec3 c7 = s5.yzw;
	vec3 c8 = s6.xyz;
	float x = worldNormal.x, y = worldNormal.y, z = worldNormal.z;
	vec3 result = c0 * 0.886227;
	result += c1 * 2.0 * 0.511664 * y;
	result += c2 * 2.0 * 0.511664 * z;
	result += c3 * 2.0 * 0.511664 * x;
	result += c4 * 2.0 * 0.429043 * x * y;
	result += c5 * 2.0 * 0.429043 * y * z;
	result += c6 * ( 0.743125 * z * z - 0.247708 );
	result += c7 * 2.0 * 0.429043 * x * z;
	result += c8 * 0.429043 * ( x * x - y * y );
	return max( result, vec3( 0.0 ) );
}
#endif`,YE=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,JE=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,QE=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,KE=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,qE=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,jE=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,$E=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,eA=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,tA=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,nA=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,iA=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,sA=`#if defined( USE_MORPHCOLORS )
	#if defined( USE_COLOR_ALPHA )
		vColor *= morphTargetBaseInfluence;
	#elif defined( USE_COLOR )
		vColor.rgb *= morphTargetBaseInfluence;
	#endif
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor.rgb += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,rA=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,oA=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,aA=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,lA=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#ifdef DOUBLE_SIDED
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#ifdef DOUBLE_SIDED
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,cA=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#if defined( USE_PACKED_NORMALMAP )
		mapN = vec3( mapN.xy, sqrt( saturate( 1.0 - dot( mapN.xy, mapN.xy ) ) ) );
	#endif
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,uA=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,dA=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,hA=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,pA=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,fA=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,mA=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,gA=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,yA=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,bA=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,xA=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	#ifdef USE_REVERSED_DEPTH_BUFFER
	
		return depth * ( far - near ) - far;
	#else
		return depth * ( near - far ) - near;
	#endif
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	
	#ifdef USE_REVERSED_DEPTH_BUFFER
		return ( near * far ) / ( ( near - far ) * depth - near );
	#else
		return ( near * far ) / ( ( far - near ) * depth - far );
	#endif
}`,vA=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,SA=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,_A=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,EA=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,AA=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,MA=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,RA=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		#define SUN_LIGHT_CASCADES 2
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#else
			uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#endif
		uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
		struct SunLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#else
			uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#endif
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#else
			uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#endif
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#elif defined( SHADOWMAP_TYPE_BASIC )
			uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#endif
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float interleavedGradientNoise( vec2 position ) {
			return fract( 52.9829189 * fract( dot( position, vec2( 0.06711056, 0.00583715 ) ) ) );
		}
		vec2 vogelDiskSample( int sampleIndex, int samplesCount, float phi ) {
			const float goldenAngle = 2.399963229728653;
			float r = sqrt( ( float( sampleIndex ) + 0.5 ) / float( samplesCount ) );
			float theta = float( sampleIndex ) * goldenAngle + phi;
			return vec2( cos( theta ), sin( theta ) ) * r;
		}
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float getShadow( sampler2DShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
				vec2 radius = shadowRadius * texelSize;
				float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
				shadow = (
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 0, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 1, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 2, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 3, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 4, 5, phi ) * radius, shadowCoord.z ) )
				) * 0.2;
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#elif defined( SHADOWMAP_TYPE_VSM )
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 distribution = texture2D( shadowMap, shadowCoord.xy ).rg;
				float mean = distribution.x;
				float variance = distribution.y * distribution.y;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					float hard_shadow = step( mean, shadowCoord.z );
				#else
					float hard_shadow = step( shadowCoord.z, mean );
				#endif
				
				if ( hard_shadow == 1.0 ) {
					shadow = 1.0;
				} else {
					variance = max( variance, 0.0000001 );
					float d = shadowCoord.z - mean;
					float p_max = variance / ( variance + d * d );
					p_max = clamp( ( p_max - 0.3 ) / 0.65, 0.0, 1.0 );
					shadow = max( hard_shadow, p_max );
				}
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#else
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				float depth = texture2D( shadowMap, shadowCoord.xy ).r;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					shadow = step( depth, shadowCoord.z );
				#else
					shadow = step( shadowCoord.z, depth );
				#endif
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#endif
	#if NUM_SUN_LIGHT_SHADOWS > 0
		float getSunShadow(
			#if defined( SHADOWMAP_TYPE_PCF )
				sampler2DShadow shadowMap,
			#else
				sampler2D shadowMap,
			#endif
			SunLightShadow sunLightShadow,
			int shadowIndex
		) {
			vec4 shadowWorldPosition = vec4( vSunShadowWorldPosition.xyz + vSunShadowWorldNormal * sunLightShadow.shadowNormalBias, 1.0 );
			float viewDepth = vSunShadowWorldPosition.w;
			int cascadeOffset = shadowIndex * SUN_LIGHT_CASCADES;
			float shadow = 1.0;
			for ( int i = SUN_LIGHT_CASCADES - 1; i >= 0; i -- ) {
				vec4 cascade = sunShadowCascade[ cascadeOffset + i ];
				if ( viewDepth >= cascade.x && viewDepth < cascade.y ) {
					float cascadeShadow = getShadow(
						shadowMap,
						sunLightShadow.shadowMapSize,
						sunLightShadow.shadowIntensity,
						sunLightShadow.shadowBias,
						sunLightShadow.shadowRadius,
						sunShadowMatrix[ cascadeOffset + i ] * shadowWorldPosition
					);
					shadow = mix( cascadeShadow, shadow, smoothstep( cascade.z, cascade.y, viewDepth ) );
				}
			}
			return shadow;
		}
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	#if defined( SHADOWMAP_TYPE_PCF )
	float getPointShadow( samplerCubeShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 bd3D = normalize( lightToPosition );
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float lightDistance = length( lightToPosition );
			float depthRange = shadowCameraFar - shadowCameraNear;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				float depthA = - shadowCameraNear / depthRange - shadowBias;
				float depthB = shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#else
				float depthA = shadowCameraFar / depthRange + shadowBias;
				float depthB = - shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#endif
			float texelSize = shadowRadius / shadowMapSize.x;
			vec3 absDir = abs( bd3D );
			vec3 tangent = absDir.x > absDir.z ? vec3( 0.0, 1.0, 0.0 ) : vec3( 1.0, 0.0, 0.0 );
			tangent = normalize( cross( bd3D, tangent ) );
			vec3 bitangent = cross( bd3D, tangent );
			float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
			shadow = 0.0;
			for ( int i = 0; i < 5; i ++ ) {
				vec2 offset = vogelDiskSample( i, 5, phi );
				vec3 direction = bd3D + ( tangent * offset.x + bitangent * offset.y ) * texelSize;
				vec3 absDirection = abs( direction );
				float dp = depthA + depthB / max( max( absDirection.x, absDirection.y ), absDirection.z );
				shadow += texture( shadowMap, vec4( direction, dp ) );
			}
			shadow *= 0.2;
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#elif defined( SHADOWMAP_TYPE_BASIC )
	float getPointShadow( samplerCube shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float dp = ( shadowCameraFar * ( viewSpaceZ - shadowCameraNear ) ) / ( viewSpaceZ * ( shadowCameraFar - shadowCameraNear ) );
			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			float depth = textureCube( shadowMap, bd3D ).r;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				depth = 1.0 - depth;
			#endif
			shadow = step( dp, depth );
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#endif
	#endif
#endif`,wA=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,TA=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	#ifdef HAS_NORMAL
		vec3 shadowWorldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
	#else
		vec3 shadowWorldNormal = vec3( 0.0 );
	#endif
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_SUN_LIGHT_SHADOWS > 0
		vSunShadowWorldPosition = vec4( worldPosition.xyz, - mvPosition.z );
		vSunShadowWorldNormal = shadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,CA=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHT_SHADOWS; i ++ ) {
		sunLight = sunLightShadows[ i ];
		shadow *= receiveShadow ? getSunShadow( sunShadowMap[ i ], sunLight, UNROLLED_LOOP_INDEX ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,IA=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,NA=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,BA=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,LA=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,FA=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,UA=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,PA=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,DA=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,GA=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseContribution, material.specularColorBlended, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,VA=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		#else
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,OA=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,kA=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	uniform mat3 diffuseRoughnessMapTransform;
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,WA=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	vDiffuseRoughnessMapUv = ( diffuseRoughnessMapTransform * vec3( DIFFUSE_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,zA=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,XA=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,ZA=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,HA=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,YA=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main() {
	#ifdef ENVMAP_TYPE_PMREM
		vec4 texColor = textureLod( envMap, backgroundRotation * vWorldDirection, roughnessToMip( backgroundBlurriness ) );
	#else
		vec4 texColor = textureCube( envMap, backgroundRotation * vWorldDirection );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,JA=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,QA=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,KA=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,qA=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	#ifdef USE_REVERSED_DEPTH_BUFFER
		float fragCoordZ = vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
	#else
		float fragCoordZ = 0.5 * vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
	#endif
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,jA=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,$A=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = vec4( dist, 0.0, 0.0, 1.0 );
}`,eM=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,tM=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,nM=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,iM=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,sM=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,rM=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,oM=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,aM=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,lM=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,cM=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,uM=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,dM=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,hM=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,pM=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,fM=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,mM=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
	uniform float diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		uniform sampler2D diffuseRoughnessMap;
	#endif
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
	uniform float retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
 
		outgoingLight = outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
 
 	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,gM=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,yM=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,bM=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,xM=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,vM=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,SM=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,_M=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,EM=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,He={alphahash_fragment:Z_,alphahash_pars_fragment:H_,alphamap_fragment:Y_,alphamap_pars_fragment:J_,alphatest_fragment:Q_,alphatest_pars_fragment:K_,aomap_fragment:q_,aomap_pars_fragment:j_,batching_pars_vertex:$_,batching_vertex:eE,begin_vertex:tE,beginnormal_vertex:nE,bsdfs:iE,iridescence_fragment:sE,bumpmap_pars_fragment:rE,clipping_planes_fragment:oE,clipping_planes_pars_fragment:aE,clipping_planes_pars_vertex:lE,clipping_planes_vertex:cE,color_fragment:uE,color_pars_fragment:dE,color_pars_vertex:hE,color_vertex:pE,common:fE,defaultnormal_vertex:mE,displacementmap_pars_vertex:gE,displacementmap_vertex:yE,emissivemap_fragment:bE,emissivemap_pars_fragment:xE,colorspace_fragment:vE,colorspace_pars_fragment:SE,envmap_fragment:_E,envmap_common_pars_fragment:EE,envmap_pars_fragment:AE,envmap_pars_vertex:ME,envmap_physical_pars_fragment:PE,envmap_vertex:RE,fog_vertex:wE,fog_pars_vertex:TE,fog_fragment:CE,fog_pars_fragment:IE,gradientmap_pars_fragment:NE,lightmap_pars_fragment:BE,lights_lambert_fragment:LE,lights_lambert_pars_fragment:FE,lights_pars_begin:UE,lights_toon_fragment:DE,lights_toon_pars_fragment:GE,lights_phong_fragment:VE,lights_phong_pars_fragment:OE,lights_physical_fragment:kE,lights_physical_pars_fragment:WE,lights_fragment_begin:zE,lights_fragment_maps:XE,lights_fragment_end:ZE,lightprobes_pars_fragment:HE,logdepthbuf_fragment:YE,logdepthbuf_pars_fragment:JE,logdepthbuf_pars_vertex:QE,logdepthbuf_vertex:KE,map_fragment:qE,map_pars_fragment:jE,map_particle_fragment:$E,map_particle_pars_fragment:eA,metalnessmap_fragment:tA,metalnessmap_pars_fragment:nA,morphinstance_vertex:iA,morphcolor_vertex:sA,morphnormal_vertex:rA,morphtarget_pars_vertex:oA,morphtarget_vertex:aA,normal_fragment_begin:lA,normal_fragment_maps:cA,normal_pars_fragment:uA,normal_pars_vertex:dA,normal_vertex:hA,normalmap_pars_fragment:pA,clearcoat_normal_fragment_begin:fA,clearcoat_normal_fragment_maps:mA,clearcoat_pars_fragment:gA,iridescence_pars_fragment:yA,opaque_fragment:bA,packing:xA,premultiplied_alpha_fragment:vA,project_vertex:SA,dithering_fragment:_A,dithering_pars_fragment:EA,roughnessmap_fragment:AA,roughnessmap_pars_fragment:MA,shadowmap_pars_fragment:RA,shadowmap_pars_vertex:wA,shadowmap_vertex:TA,shadowmask_pars_fragment:CA,skinbase_vertex:IA,skinning_pars_vertex:NA,skinning_vertex:BA,skinnormal_vertex:LA,specularmap_fragment:FA,specularmap_pars_fragment:UA,tonemapping_fragment:PA,tonemapping_pars_fragment:DA,transmission_fragment:GA,transmission_pars_fragment:VA,uv_pars_fragment:OA,uv_pars_vertex:kA,uv_vertex:WA,worldpos_vertex:zA,background_vert:XA,background_frag:ZA,backgroundCube_vert:HA,backgroundCube_frag:YA,cube_vert:JA,cube_frag:QA,depth_vert:KA,depth_frag:qA,distance_vert:jA,distance_frag:$A,equirect_vert:eM,equirect_frag:tM,linedashed_vert:nM,linedashed_frag:iM,meshbasic_vert:sM,meshbasic_frag:rM,meshlambert_vert:oM,meshlambert_frag:aM,meshmatcap_vert:lM,meshmatcap_frag:cM,meshnormal_vert:uM,meshnormal_frag:dM,meshphong_vert:hM,meshphong_frag:pM,meshphysical_vert:fM,meshphysical_frag:mM,meshtoon_vert:gM,meshtoon_frag:yM,points_vert:bM,points_frag:xM,shadow_vert:vM,shadow_frag:SM,sprite_vert:_M,sprite_frag:EM},ge={common:{diffuse:{value:new We(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new De},alphaMap:{value:null},alphaMapTransform:{value:new De},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new De}},envmap:{envMap:{value:null},envMapRotation:{value:new De},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new De}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new De}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new De},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new De},normalScale:{value:new Be(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new De},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new De}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new De}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new De}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new We(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new We(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new De},alphaTest:{value:0},uvTransform:{value:new De}},sprite:{diffuse:{value:new We(16777215)},opacity:{value:1},center:{value:new Be(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new De},alphaMap:{value:null},alphaMapTransform:{value:new De},alphaTest:{value:0}}},Si={basic:{uniforms:cn([ge.common,ge.specularmap,ge.envmap,ge.aomap,ge.lightmap,ge.fog]),vertexShader:He.meshbasic_vert,fragmentShader:He.meshbasic_frag},lambert:{uniforms:cn([ge.common,ge.specularmap,ge.envmap,ge.aomap,ge.lightmap,ge.emissivemap,ge.bumpmap,ge.normalmap,ge.displacementmap,ge.fog,ge.lights,{emissive:{value:new We(0)},envMapIntensity:{value:1}}]),vertexShader:He.meshlambert_vert,fragmentShader:He.meshlambert_frag},phong:{uniforms:cn([ge.common,ge.specularmap,ge.envmap,ge.aomap,ge.lightmap,ge.emissivemap,ge.bumpmap,ge.normalmap,ge.displacementmap,ge.fog,ge.lights,{emissive:{value:new We(0)},specular:{value:new We(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:He.meshphong_vert,fragmentShader:He.meshphong_frag},standard:{uniforms:cn([ge.common,ge.envmap,ge.aomap,ge.lightmap,ge.emissivemap,ge.bumpmap,ge.normalmap,ge.displacementmap,ge.roughnessmap,ge.metalnessmap,ge.fog,ge.lights,{emissive:{value:new We(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:He.meshphysical_vert,fragmentShader:He.meshphysical_frag},toon:{uniforms:cn([ge.common,ge.aomap,ge.lightmap,ge.emissivemap,ge.bumpmap,ge.normalmap,ge.displacementmap,ge.gradientmap,ge.fog,ge.lights,{emissive:{value:new We(0)}}]),vertexShader:He.meshtoon_vert,fragmentShader:He.meshtoon_frag},matcap:{uniforms:cn([ge.common,ge.bumpmap,ge.normalmap,ge.displacementmap,ge.fog,{matcap:{value:null}}]),vertexShader:He.meshmatcap_vert,fragmentShader:He.meshmatcap_frag},points:{uniforms:cn([ge.points,ge.fog]),vertexShader:He.points_vert,fragmentShader:He.points_frag},dashed:{uniforms:cn([ge.common,ge.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:He.linedashed_vert,fragmentShader:He.linedashed_frag},depth:{uniforms:cn([ge.common,ge.displacementmap]),vertexShader:He.depth_vert,fragmentShader:He.depth_frag},normal:{uniforms:cn([ge.common,ge.bumpmap,ge.normalmap,ge.displacementmap,{opacity:{value:1}}]),vertexShader:He.meshnormal_vert,fragmentShader:He.meshnormal_frag},sprite:{uniforms:cn([ge.sprite,ge.fog]),vertexShader:He.sprite_vert,fragmentShader:He.sprite_frag},background:{uniforms:{uvTransform:{value:new De},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:He.background_vert,fragmentShader:He.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new De}},vertexShader:He.backgroundCube_vert,fragmentShader:He.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:He.cube_vert,fragmentShader:He.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:He.equirect_vert,fragmentShader:He.equirect_frag},distance:{uniforms:cn([ge.common,ge.displacementmap,{referencePosition:{value:new F},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:He.distance_vert,fragmentShader:He.distance_frag},shadow:{uniforms:cn([ge.lights,ge.fog,{color:{value:new We(0)},opacity:{value:1}}]),vertexShader:He.shadow_vert,fragmentShader:He.shadow_frag}};Si.physical={uniforms:cn([Si.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new De},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new De},clearcoatNormalScale:{value:new Be(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new De},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new De},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new De},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new De},sheen:{value:0},sheenColor:{value:new We(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new De},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new De},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new De},transmissionSamplerSize:{value:new Be},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new De},attenuationDistance:{value:0},attenuationColor:{value:new We(0)},specularColor:{value:new We(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new De},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new De},anisotropyVector:{value:new Be},anisotropyMap:{value:null},anisotropyMapTransform:{value:new De}}]),vertexShader:He.meshphysical_vert,fragmentShader:He.meshphysical_frag};var Zc={r:0,b:0,g:0},AM=new Ye,Fb=new De;Fb.set(-1,0,0,0,1,0,0,0,1);function MM(n,e,t,i,s,r){let o=new We(0),a=s===!0?0:1,l,c,u=null,h=0,p=null;function d(S){let A=S.isScene===!0?S.background:null;if(A&&A.isTexture){let _=S.backgroundBlurriness>0;A=e.get(A,_)}return A}function f(S){let A=!1,_=d(S);_===null?g(o,a):_&&_.isColor&&(g(_,1),A=!0);let w=n.xr.getEnvironmentBlendMode();w==="additive"?t.buffers.color.setClear(0,0,0,1,r):w==="alpha-blend"&&t.buffers.color.setClear(0,0,0,0,r),(n.autoClear||A)&&(t.buffers.depth.setTest(!0),t.buffers.depth.setMask(!0),t.buffers.color.setMask(!0),n.clear(n.autoClearColor,n.autoClearDepth,n.autoClearStencil))}function b(S,A){let _=d(A);_&&_.isCubeTexture?(c===void 0&&(c=new Mt(new ai(1,1,1),new bi({name:"BackgroundCubeMaterial",uniforms:Ns(Si.backgroundCube.uniforms),vertexShader:Si.backgroundCube.vertexShader,fragmentShader:Si.backgroundCube.fragmentShader,side:bn,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),c.geometry.deleteAttribute("uv"),c.onBeforeRender=function(w,R,y){this.matrixWorld.copyPosition(y.matrixWorld)},Object.defineProperty(c.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),i.update(c)),c.material.uniforms.envMap.value=_,c.material.uniforms.backgroundBlurriness.value=A.backgroundBlurriness,c.material.uniforms.backgroundIntensity.value=A.backgroundIntensity,c.material.uniforms.backgroundRotation.value.setFromMatrix4(AM.makeRotationFromEuler(A.backgroundRotation)).transpose(),_.isRenderTargetTexture===!1&&c.material.uniforms.backgroundRotation.value.premultiply(Fb),c.material.toneMapped=je.getTransfer(_.colorSpace)!==ct,(u!==_||h!==_.version||p!==n.toneMapping)&&(c.material.needsUpdate=!0,u=_,h=_.version,p=n.toneMapping),c.layers.enableAll(),S.unshift(c,c.geometry,c.material,0,0,null)):_&&_.isTexture&&(l===void 0&&(l=new Mt(new Pi(2,2),new bi({name:"BackgroundMaterial",uniforms:Ns(Si.background.uniforms),vertexShader:Si.background.vertexShader,fragmentShader:Si.background.fragmentShader,side:rs,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),Object.defineProperty(l.material,"map",{get:function(){return this.uniforms.t2D.value}}),i.update(l)),l.material.uniforms.t2D.value=_,l.material.uniforms.backgroundIntensity.value=A.backgroundIntensity,l.material.toneMapped=je.getTransfer(_.colorSpace)!==ct,_.matrixAutoUpdate===!0&&_.updateMatrix(),l.material.uniforms.uvTransform.value.copy(_.matrix),(u!==_||h!==_.version||p!==n.toneMapping)&&(l.material.needsUpdate=!0,u=_,h=_.version,p=n.toneMapping),l.layers.enableAll(),S.unshift(l,l.geometry,l.material,0,0,null))}function g(S,A){S.getRGB(Zc,Fh(n)),t.buffers.color.setClear(Zc.r,Zc.g,Zc.b,A,r)}function m(){c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0),l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0)}return{getClearColor:function(){return o},setClearColor:function(S,A=1){o.set(S),a=A,g(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(S){a=S,g(o,a)},render:f,addToRenderList:b,dispose:m}}function RM(n,e){let t=n.getParameter(n.MAX_VERTEX_ATTRIBS),i={},s=p(null),r=s,o=!1;function a(P,D,W,I,X){let Y=!1,z=h(P,I,W,D);r!==z&&(r=z,c(r.object)),Y=d(P,I,W,X),Y&&f(P,I,W,X),X!==null&&e.update(X,n.ELEMENT_ARRAY_BUFFER),(Y||o)&&(o=!1,_(P,D,W,I),X!==null&&n.bindBuffer(n.ELEMENT_ARRAY_BUFFER,e.get(X).buffer))}function l(){return n.createVertexArray()}function c(P){return n.bindVertexArray(P)}function u(P){return n.deleteVertexArray(P)}function h(P,D,W,I){let X=I.wireframe===!0,Y=i[D.id];Y===void 0&&(Y={},i[D.id]=Y);let z=P.isInstancedMesh===!0?P.id:0,ne=Y[z];ne===void 0&&(ne={},Y[z]=ne);let H=ne[W.id];H===void 0&&(H={},ne[W.id]=H);let $=H[X];return $===void 0&&($=p(l()),H[X]=$),$}function p(P){let D=[],W=[],I=[];for(let X=0;X<t;X++)D[X]=0,W[X]=0,I[X]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:D,enabledAttributes:W,attributeDivisors:I,object:P,attributes:{},index:null}}function d(P,D,W,I){let X=r.attributes,Y=D.attributes,z=0,ne=W.getAttributes();for(let H in ne)if(ne[H].location>=0){let ee=X[H],Me=Y[H];if(Me===void 0&&(H==="instanceMatrix"&&P.instanceMatrix&&(Me=P.instanceMatrix),H==="instanceColor"&&P.instanceColor&&(Me=P.instanceColor)),ee===void 0||ee.attribute!==Me||Me&&ee.data!==Me.data)return!0;z++}return r.attributesNum!==z||r.index!==I}function f(P,D,W,I){let X={},Y=D.attributes,z=0,ne=W.getAttributes();for(let H in ne)if(ne[H].location>=0){let ee=Y[H];ee===void 0&&(H==="instanceMatrix"&&P.instanceMatrix&&(ee=P.instanceMatrix),H==="instanceColor"&&P.instanceColor&&(ee=P.instanceColor));let Me={};Me.attribute=ee,ee&&ee.data&&(Me.data=ee.data),X[H]=Me,z++}r.attributes=X,r.attributesNum=z,r.index=I}function b(){let P=r.newAttributes;for(let D=0,W=P.length;D<W;D++)P[D]=0}function g(P){m(P,0)}function m(P,D){let W=r.newAttributes,I=r.enabledAttributes,X=r.attributeDivisors;W[P]=1,I[P]===0&&(n.enableVertexAttribArray(P),I[P]=1),X[P]!==D&&(n.vertexAttribDivisor(P,D),X[P]=D)}function S(){let P=r.newAttributes,D=r.enabledAttributes;for(let W=0,I=D.length;W<I;W++)D[W]!==P[W]&&(n.disableVertexAttribArray(W),D[W]=0)}function A(P,D,W,I,X,Y,z){z===!0?n.vertexAttribIPointer(P,D,W,X,Y):n.vertexAttribPointer(P,D,W,I,X,Y)}function _(P,D,W,I){b();let X=I.attributes,Y=W.getAttributes(),z=D.defaultAttributeValues;for(let ne in Y){let H=Y[ne];if(H.location>=0){let $=X[ne];if($===void 0&&(ne==="instanceMatrix"&&P.instanceMatrix&&($=P.instanceMatrix),ne==="instanceColor"&&P.instanceColor&&($=P.instanceColor)),$!==void 0){let ee=$.normalized,Me=$.itemSize,Oe=e.get($);if(Oe===void 0)continue;let K=Oe.buffer,ye=Oe.type,Se=Oe.bytesPerElement,Le=ye===n.INT||ye===n.UNSIGNED_INT||$.gpuType===cc;if($.isInterleavedBufferAttribute){let be=$.data,ze=be.isInterleavedBuffer===!0?be.stride:be.itemSize,Nt=$.offset;if(be.isInstancedInterleavedBuffer||be.isInstancedBufferAttribute){for(let Ue=0;Ue<H.locationSize;Ue++)m(H.location+Ue,be.meshPerAttribute);P.isInstancedMesh!==!0&&I._maxInstanceCount===void 0&&(I._maxInstanceCount=be.meshPerAttribute*be.count)}else for(let Ue=0;Ue<H.locationSize;Ue++)g(H.location+Ue);n.bindBuffer(n.ARRAY_BUFFER,K);for(let Ue=0;Ue<H.locationSize;Ue++)A(H.location+Ue,Me/H.locationSize,ye,ee,ze*Se,(Nt+Me/H.locationSize*Ue)*Se,Le)}else{if($.isInstancedBufferAttribute){for(let be=0;be<H.locationSize;be++)m(H.location+be,$.meshPerAttribute);P.isInstancedMesh!==!0&&I._maxInstanceCount===void 0&&(I._maxInstanceCount=$.meshPerAttribute*$.count)}else for(let be=0;be<H.locationSize;be++)g(H.location+be);n.bindBuffer(n.ARRAY_BUFFER,K);for(let be=0;be<H.locationSize;be++)A(H.location+be,Me/H.locationSize,ye,ee,Me*Se,Me/H.locationSize*be*Se,Le)}}else if(z!==void 0){let ee=z[ne];if(ee!==void 0)switch(ee.length){case 2:n.vertexAttrib2fv(H.location,ee);break;case 3:n.vertexAttrib3fv(H.location,ee);break;case 4:n.vertexAttrib4fv(H.location,ee);break;default:n.vertexAttrib1fv(H.location,ee)}}}}S()}function w(){L();for(let P in i){let D=i[P];for(let W in D){let I=D[W];for(let X in I){let Y=I[X];for(let z in Y)u(Y[z].object),delete Y[z];delete I[X]}}delete i[P]}}function R(P){if(i[P.id]===void 0)return;let D=i[P.id];for(let W in D){let I=D[W];for(let X in I){let Y=I[X];for(let z in Y)u(Y[z].object),delete Y[z];delete I[X]}}delete i[P.id]}function y(P){for(let D in i){let W=i[D];for(let I in W){let X=W[I];if(X[P.id]===void 0)continue;let Y=X[P.id];for(let z in Y)u(Y[z].object),delete Y[z];delete X[P.id]}}}function E(P){for(let D in i){let W=i[D],I=P.isInstancedMesh===!0?P.id:0,X=W[I];if(X!==void 0){for(let Y in X){let z=X[Y];for(let ne in z)u(z[ne].object),delete z[ne];delete X[Y]}delete W[I],Object.keys(W).length===0&&delete i[D]}}}function L(){C(),o=!0,r!==s&&(r=s,c(r.object))}function C(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:a,reset:L,resetDefaultState:C,dispose:w,releaseStatesOfGeometry:R,releaseStatesOfObject:E,releaseStatesOfProgram:y,initAttributes:b,enableAttribute:g,disableUnusedAttributes:S}}function wM(n,e,t){let i;function s(l){i=l}function r(l,c){n.drawArrays(i,l,c),t.update(c,i,1)}function o(l,c,u){u!==0&&(n.drawArraysInstanced(i,l,c,u),t.update(c,i,u))}function a(l,c,u){if(u===0)return;e.get("WEBGL_multi_draw").multiDrawArraysWEBGL(i,l,0,c,0,u);let p=0;for(let d=0;d<u;d++)p+=c[d];t.update(p,i,1)}this.setMode=s,this.render=r,this.renderInstances=o,this.renderMultiDraw=a}function TM(n,e,t,i){let s;function r(){if(s!==void 0)return s;if(e.has("EXT_texture_filter_anisotropic")===!0){let y=e.get("EXT_texture_filter_anisotropic");s=n.getParameter(y.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function o(y){return!(y!==Hn&&i.convert(y)!==n.getParameter(n.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(y){let E=y===ui&&(e.has("EXT_color_buffer_half_float")||e.has("EXT_color_buffer_float"));return!(y!==Mn&&y!==Zn&&!E&&i.convert(y)!==n.getParameter(n.IMPLEMENTATION_COLOR_READ_TYPE))}function l(y){if(y==="highp"){if(n.getShaderPrecisionFormat(n.VERTEX_SHADER,n.HIGH_FLOAT).precision>0&&n.getShaderPrecisionFormat(n.FRAGMENT_SHADER,n.HIGH_FLOAT).precision>0)return"highp";y="mediump"}return y==="mediump"&&n.getShaderPrecisionFormat(n.VERTEX_SHADER,n.MEDIUM_FLOAT).precision>0&&n.getShaderPrecisionFormat(n.FRAGMENT_SHADER,n.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=t.precision!==void 0?t.precision:"highp",u=l(c);u!==c&&(Ne("WebGLRenderer:",c,"not supported, using",u,"instead."),c=u);let h=t.reversedDepthBuffer===!0&&e.has("EXT_clip_control"),p=t.logarithmicDepthBuffer===!0&&h===!1;t.reversedDepthBuffer===!0&&h===!1&&Ne("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),t.logarithmicDepthBuffer===!0&&h===!0&&Ne("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let d=n.getParameter(n.MAX_TEXTURE_IMAGE_UNITS),f=n.getParameter(n.MAX_VERTEX_TEXTURE_IMAGE_UNITS),b=n.getParameter(n.MAX_TEXTURE_SIZE),g=n.getParameter(n.MAX_CUBE_MAP_TEXTURE_SIZE),m=n.getParameter(n.MAX_VERTEX_ATTRIBS),S=n.getParameter(n.MAX_VERTEX_UNIFORM_VECTORS),A=n.getParameter(n.MAX_VARYING_VECTORS),_=n.getParameter(n.MAX_FRAGMENT_UNIFORM_VECTORS),w=n.getParameter(n.MAX_SAMPLES),R=n.getParameter(n.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:o,textureTypeReadable:a,precision:c,logarithmicDepthBuffer:p,reversedDepthBuffer:h,maxTextures:d,maxVertexTextures:f,maxTextureSize:b,maxCubemapSize:g,maxAttributes:m,maxVertexUniforms:S,maxVaryings:A,maxFragmentUniforms:_,maxSamples:w,samples:R}}function CM(n){let e=this,t=null,i=0,s=!1,r=!1,o=new fn,a=new De,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(h,p){let d=h.length!==0||p||i!==0||s;return s=p,i=h.length,d},this.beginShadows=function(){r=!0,u(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(h,p){t=u(h,p,0)},this.setState=function(h,p,d){let f=h.clippingPlanes,b=h.clipIntersection,g=h.clipShadows,m=n.get(h);if(!s||f===null||f.length===0||r&&!g)r?u(null):c();else{let S=r?0:i,A=S*4,_=m.clippingState||null;l.value=_,_=u(f,p,A,d);for(let w=0;w!==A;++w)_[w]=t[w];m.clippingState=_,this.numIntersection=b?this.numPlanes:0,this.numPlanes+=S}};function c(){l.value!==t&&(l.value=t,l.needsUpdate=i>0),e.numPlanes=i,e.numIntersection=0}function u(h,p,d,f){let b=h!==null?h.length:0,g=null;if(b!==0){if(g=l.value,f!==!0||g===null){let m=d+b*4,S=p.matrixWorldInverse;a.getNormalMatrix(S),(g===null||g.length<m)&&(g=new Float32Array(m));for(let A=0,_=d;A!==b;++A,_+=4)o.copy(h[A]).applyMatrix4(S,a),o.normal.toArray(g,_),g[_+3]=o.constant}l.value=g,l.needsUpdate=!0}return e.numPlanes=b,e.numIntersection=0,g}}var ia=class extends Bn{constructor(e=1,t={}){super(e,e,t),this.isWebGLCubeRenderTarget=!0;let i={width:e,height:e,depth:1},s=[i,i,i,i,i,i];this.texture=new Io(s),this._setTextureOptions(t),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(e,t){this.texture.type=t.type,this.texture.colorSpace=t.colorSpace,this.texture.generateMipmaps=t.generateMipmaps,this.texture.minFilter=t.minFilter,this.texture.magFilter=t.magFilter;let i={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},s=new ai(5,5,5),r=new bi({name:"CubemapFromEquirect",uniforms:Ns(i.uniforms),vertexShader:i.vertexShader,fragmentShader:i.fragmentShader,side:bn,blending:Rs});r.uniforms.tEquirect.value=t;let o=new Mt(s,r),a=t.minFilter;return t.minFilter===Gi&&(t.minFilter=gn),new Er(1,10,this).update(e,o),t.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(e,t=!0,i=!0,s=!0){let r=e.getRenderTarget();for(let o=0;o<6;o++)e.setRenderTarget(this,o),e.clear(t,i,s);e.setRenderTarget(r)}},hb=256,IM=3,NM=20,Ub=256,Pb=16,BM=3,LM=new F,FM=new We,Yc=class n{constructor(e){this._renderer=e,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new Er(1,10,null),this._boxMesh=new Mt(new ai(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(e,t=0,i=.1,s=100,r={}){let{size:o=256,position:a=LM}=r,l=this._renderer;this._setSize(o);let c=this._allocateTarget(),u=this._getSourceTarget(!0);t>0&&(u.texture.mipmapsAutoUpdate=!1);let h=l.autoClear,p=l.autoClearColor,d=l.autoClearDepth,f=l.autoClearStencil,b=e.background;l.autoClear=!0,l.autoClearColor=!0,l.autoClearDepth=!0,l.autoClearStencil=!0,b===null&&(e.background=l.getClearColor(FM));let g=new Er(i,s,u);return g.position.copy(a),g.update(l,e),l.autoClear=h,l.autoClearColor=p,l.autoClearDepth=d,l.autoClearStencil=f,e.background=b,t>0&&(u.texture.mipmapsAutoUpdate=!0,this._blur(c,t)),this._applyPMREM(c),c}fromEquirectangular(e,t=null){return this._fromTexture(e,t)}fromCubemap(e,t=null){return this._fromTexture(e,t)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=mb(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=fb(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(e,t){return t>0?1-Math.sqrt(1-e/t):0}_setSize(e){this._cubeSize=Math.max(hb,Bh(e))}_fromTexture(e,t){e.mapping===Ts||e.mapping===wr?this._setSize(e.image.length===0?hb:e.image[0].width||e.image[0].image.width):this._setSize(e.image.width/4);let i=t||this._allocateTarget();return this._textureToCubemap(e),this._applyPMREM(i),i}_allocateTarget(){let e=this._cubeSize,t=pb(e,!1,!1),i=Math.log2(e)-IM;for(let s=0;s<=i;s++)t.texture.mipmaps.push({width:e>>s,height:e>>s});return t.texture.name="PMREM",t.texture.isPMREMTexture=!0,t}_getSourceTarget(e=!1){let t=this._cubeSize,i=this._sourceTarget;return(i===null||i.width!==t||e&&i.depthBuffer===!1)&&(i!==null&&i.dispose(),this._sourceTarget=pb(t,!0,e)),this._sourceTarget}_compileMaterial(e){this._boxMesh.material=e,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(e,t,i){let s=this._boxMesh,r=this._cubeCamera;s.material=i,r.renderTarget=e,r.activeMipmapLevel=t;let o=e.width>>t;e.viewport.set(0,0,o,o),r.update(this._renderer,s),e.viewport.set(0,0,e.width,e.height)}_textureToCubemap(e){let t;e.mapping===Ts||e.mapping===wr?(this._cubemapMaterial===null&&(this._cubemapMaterial=mb()),t=this._cubemapMaterial,t.uniforms.flipEnvMap.value=e.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=fb()),t=this._equirectMaterial),t.uniforms.envMap.value=e,this._renderCube(this._getSourceTarget(),0,t)}_applyPMREM(e){this._ggxMaterial===null&&(this._ggxMaterial=UM(),this._integrationMaterial=PM());let t=this._cubeSize,i=e.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(t/Pb);for(let o=0;o<=i;o++){let a=n.lodToRoughness(o,i);if(o>i-BM)r.roughness.value=a,this._renderCube(e,o,this._integrationMaterial);else{let l=a>0?Math.log2(t)+.5*Math.log2(6/(Ub*Math.pow(a,4)))+.5:0;s.roughness.value=a,s.lodBias.value=l,this._renderCube(e,o,this._ggxMaterial)}}}_blur(e,t){this._blurMaterial===null&&(this._blurMaterial=DM());let i=this._blurMaterial,s=i.uniforms,r=this._sourceTarget;s.sigma.value=Math.min(t,Math.PI)/Math.SQRT2,s.envMap.value=r.texture,this._renderCube(e,0,i),s.envMap.value=e.texture,this._renderCube(r,0,i)}};function pb(n,e,t){return new ia(n,{minFilter:Gi,generateMipmaps:e,type:ui,colorSpace:xo,depthBuffer:t})}function sa(n,e,t){return new bi({name:n,uniforms:e,vertexShader:He.cube_vert,fragmentShader:t,side:bn,blending:Rs,depthTest:!1,depthWrite:!1})}function UM(){return sa("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${Ub}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function PM(){return sa("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:Pb}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function DM(){return sa("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${NM}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function fb(){return sa("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function mb(){return sa("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function GM(n){let e=new WeakMap,t=new WeakMap,i=null;function s(p,d=!1){return p==null?null:d?o(p):r(p)}function r(p){if(p&&p.isTexture){let d=p.mapping;if(d===oc||d===ac)if(e.has(p)){let f=e.get(p).texture;return a(f,p.mapping)}else{let f=p.image;if(f&&f.height>0){let b=new ia(f.height);return b.fromEquirectangularTexture(n,p),e.set(p,b),p.addEventListener("dispose",c),a(b.texture,p.mapping)}else return null}}return p}function o(p){if(p&&p.isTexture&&p.isPMREMTexture!==!0){let d=p.mapping,f=d===oc||d===ac,b=d===Ts||d===wr;if(f||b){let g=t.get(p),m=g!==void 0?g.texture.pmremVersion:0;if(p.isRenderTargetTexture&&p.pmremVersion!==m)return i===null&&(i=new Yc(n)),g=f?i.fromEquirectangular(p,g):i.fromCubemap(p,g),g.texture.pmremVersion=p.pmremVersion,t.set(p,g),g.texture;if(g!==void 0)return g.texture;{let S=p.image;return f&&S&&S.height>0||b&&S&&l(S)?(i===null&&(i=new Yc(n)),g=f?i.fromEquirectangular(p):i.fromCubemap(p),g.texture.pmremVersion=p.pmremVersion,t.set(p,g),p.addEventListener("dispose",u),g.texture):null}}}return p}function a(p,d){return d===oc?p.mapping=Ts:d===ac&&(p.mapping=wr),p}function l(p){let d=0,f=6;for(let b=0;b<f;b++)p[b]!==void 0&&d++;return d===f}function c(p){let d=p.target;d.removeEventListener("dispose",c);let f=e.get(d);f!==void 0&&(e.delete(d),f.dispose())}function u(p){let d=p.target;d.removeEventListener("dispose",u);let f=t.get(d);f!==void 0&&(t.delete(d),f.dispose())}function h(){e=new WeakMap,t=new WeakMap,i!==null&&(i.dispose(),i=null)}return{get:s,dispose:h}}function VM(n){let e={};function t(i){if(e[i]!==void 0)return e[i];let s=n.getExtension(i);return e[i]=s,s}return{has:function(i){return t(i)!==null},init:function(){t("EXT_color_buffer_float"),t("WEBGL_clip_cull_distance"),t("OES_texture_float_linear"),t("EXT_color_buffer_half_float"),t("WEBGL_multisampled_render_to_texture"),t("WEBGL_render_shared_exponent")},get:function(i){let s=t(i);return s===null&&mo("WebGLRenderer: "+i+" extension not supported."),s}}}function OM(n,e,t,i){let s={},r=new WeakMap,o=new FinalizationRegistry(f=>delete s[f]);function a(f){l(f.target)}function l(f){f.index!==null&&e.remove(f.index);for(let g in f.attributes)e.remove(f.attributes[g]);f.removeEventListener("dispose",a),delete s[f.id],o.unregister(f);let b=r.get(f);b&&(e.remove(b),r.delete(f)),i.releaseStatesOfGeometry(f),f.isInstancedBufferGeometry===!0&&delete f._maxInstanceCount,t.memory.geometries--}function c(f,b){return s[b.id]!==void 0||(b.addEventListener("dispose",a),s[b.id]=new WeakRef(b),o.register(b,b.id,b),t.memory.geometries++),b}function u(f){let b=f.attributes;for(let g in b)e.update(b[g],n.ARRAY_BUFFER)}function h(f){let b=f.index,g=f.attributes.position,m=0;if(g===void 0)return;let S=b!==null?b.array.length:g.array.length/3-1,A=g.count>=65535?Mo:_s,_=new A(Math.ceil(S/3)*6,1),w=_.array;if(b!==null){let y=b.array;m=b.version;for(let E=0,L=0;E<S;E+=3){let C=y[E+0],P=y[E+1],D=y[E+2];w[L++]=C,w[L++]=P,w[L++]=P,w[L++]=D,w[L++]=D,w[L++]=C}}else{m=g.version;for(let y=0,E=0;y<S;y+=3){let L=y+0,C=y+1,P=y+2;w[E++]=L,w[E++]=C,w[E++]=C,w[E++]=P,w[E++]=P,w[E++]=L}}_.version=m;let R=r.get(f);R&&e.remove(R),r.set(f,_)}function p(f){let b=r.get(f);if(b){let g=f.index;g!==null&&b.version<g.version&&h(f)}else h(f);return r.get(f)}function d(){for(let f in s){let b=s[f].deref();b!==void 0&&l(b)}}return{get:c,update:u,getWireframeAttribute:p,dispose:d}}function kM(n,e,t){let i;function s(h){i=h}let r,o;function a(h){r=h.type,o=h.bytesPerElement}function l(h,p){n.drawElements(i,p,r,h*o),t.update(p,i,1)}function c(h,p,d){d!==0&&(n.drawElementsInstanced(i,p,r,h*o,d),t.update(p,i,d))}function u(h,p,d){if(d===0)return;e.get("WEBGL_multi_draw").multiDrawElementsWEBGL(i,p,0,r,h,0,d);let b=0;for(let g=0;g<d;g++)b+=p[g];t.update(b,i,1)}this.setMode=s,this.setIndex=a,this.render=l,this.renderInstances=c,this.renderMultiDraw=u}function WM(n){let e={geometries:0,textures:0},t={frame:0,calls:0,triangles:0,points:0,lines:0};function i(r,o,a){switch(t.calls++,o){case n.TRIANGLES:t.triangles+=a*(r/3);break;case n.LINES:t.lines+=a*(r/2);break;case n.LINE_STRIP:t.lines+=a*(r-1);break;case n.LINE_LOOP:t.lines+=a*r;break;case n.POINTS:t.points+=a*r;break;default:Pe("WebGLInfo: Unknown draw mode:",o);break}}function s(){t.calls=0,t.triangles=0,t.points=0,t.lines=0}return{memory:e,render:t,programs:null,autoReset:!0,reset:s,update:i}}function zM(n,e,t){let i=new WeakMap,s=new mt;function r(o,a,l){let c=o.morphTargetInfluences,u=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,h=u!==void 0?u.length:0,p=i.get(a);if(p===void 0||p.count!==h){let L=function(){y.dispose(),i.delete(a),a.removeEventListener("dispose",L)};p!==void 0&&p.texture.dispose();let d=a.morphAttributes.position!==void 0,f=a.morphAttributes.normal!==void 0,b=a.morphAttributes.color!==void 0,g=a.morphAttributes.position||[],m=a.morphAttributes.normal||[],S=a.morphAttributes.color||[],A=0;d===!0&&(A=1),f===!0&&(A=2),b===!0&&(A=3);let _=a.attributes.position.count*A,w=1;_>e.maxTextureSize&&(w=Math.ceil(_/e.maxTextureSize),_=e.maxTextureSize);let R=new Float32Array(_*w*4*h),y=new _o(R,_,w,h);y.type=Zn,y.needsUpdate=!0;let E=A*4;for(let C=0;C<h;C++){let P=g[C],D=m[C],W=S[C],I=_*w*4*C;for(let X=0;X<P.count;X++){let Y=X*E;d===!0&&(s.fromBufferAttribute(P,X),R[I+Y+0]=s.x,R[I+Y+1]=s.y,R[I+Y+2]=s.z,R[I+Y+3]=0),f===!0&&(s.fromBufferAttribute(D,X),R[I+Y+4]=s.x,R[I+Y+5]=s.y,R[I+Y+6]=s.z,R[I+Y+7]=0),b===!0&&(s.fromBufferAttribute(W,X),R[I+Y+8]=s.x,R[I+Y+9]=s.y,R[I+Y+10]=s.z,R[I+Y+11]=W.itemSize===4?s.w:1)}}p={count:h,texture:y,size:new Be(_,w)},i.set(a,p),a.addEventListener("dispose",L)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)l.getUniforms().setValue(n,"morphTexture",o.morphTexture,t);else{let d=0;for(let b=0;b<c.length;b++)d+=c[b];let f=a.morphTargetsRelative?1:1-d;l.getUniforms().setValue(n,"morphTargetBaseInfluence",f),l.getUniforms().setValue(n,"morphTargetInfluences",c)}l.getUniforms().setValue(n,"morphTargetsTexture",p.texture,t),l.getUniforms().setValue(n,"morphTargetsTextureSize",p.size)}return{update:r}}function XM(n,e,t,i,s){let r=new WeakMap;function o(c){let u=s.render.frame,h=c.geometry,p=e.get(c,h);if(r.get(p)!==u&&(e.update(p),r.set(p,u)),c.isInstancedMesh&&(c.hasEventListener("dispose",l)===!1&&c.addEventListener("dispose",l),r.get(c)!==u&&(t.update(c.instanceMatrix,n.ARRAY_BUFFER),c.instanceColor!==null&&t.update(c.instanceColor,n.ARRAY_BUFFER),r.set(c,u))),c.isSkinnedMesh){let d=c.skeleton;r.get(d)!==u&&(d.update(),r.set(d,u))}return p}function a(){r=new WeakMap}function l(c){let u=c.target;u.removeEventListener("dispose",l),i.releaseStatesOfObject(u),t.remove(u.instanceMatrix),u.instanceColor!==null&&t.remove(u.instanceColor)}return{update:o,dispose:a}}var ZM={[hh]:"LINEAR_TONE_MAPPING",[ph]:"REINHARD_TONE_MAPPING",[fh]:"CINEON_TONE_MAPPING",[mh]:"ACES_FILMIC_TONE_MAPPING",[yh]:"AGX_TONE_MAPPING",[Ho]:"NEUTRAL_TONE_MAPPING",[gh]:"CUSTOM_TONE_MAPPING"};function HM(n,e,t,i,s,r){let o=new Bn(e,t,{type:n,depthBuffer:s,stencilBuffer:r,samples:i?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,l=null,c=null,u=new Ot;u.setAttribute("position",new ft([-1,3,0,-1,-1,0,3,-1,0],3)),u.setAttribute("uv",new ft([0,2,0,0,2,0],2));let h=new Xl({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),p=new Mt(u,h),d=new Wo(-1,1,1,-1,0,1),f=null,b=null,g=!1,m,S=null,A=[],_=!1;this.setSize=function(w,R){o.setSize(w,R),a!==null&&a.setSize(w,R),l!==null&&l.setSize(w,R);for(let y=0;y<A.length;y++){let E=A[y];E.setSize&&E.setSize(w,R)}},this.setEffects=function(w){A=w,_=A.length>0&&A[0].isRenderPass===!0;let R=o.width,y=o.height;A.length>0&&a===null&&(a=new Bn(R,y,{type:ui,depthBuffer:!1,stencilBuffer:!1}),l=new Bn(R,y,{type:ui,depthBuffer:!1,stencilBuffer:!1}));let E=s===!0&&A.some(L=>L.needsDepthTexture===!0);E!==(o.depthTexture!==null)&&(E===!0&&c===null&&(c=new Ui(R,y),r===!0&&(c.format=Vi,c.type=Cs)),o.dispose(),o.depthTexture=E?c:null,o.resolveDepthBuffer=E,o.storeMultisampledDepthBuffer=E);for(let L=0;L<A.length;L++){let C=A[L];C.setSize&&C.setSize(R,y),E&&C.needsDepthTexture===!0&&C.setDepthTexture&&C.setDepthTexture(c)}},this.begin=function(w,R){if(g||w.toneMapping===xi&&A.length===0)return!1;if(S=R,R!==null){let y=R.width,E=R.height;(o.width!==y||o.height!==E)&&this.setSize(y,E)}return _===!1&&w.setRenderTarget(o),m=w.toneMapping,w.toneMapping=xi,!0},this.hasRenderPass=function(){return _},this.end=function(w,R){w.toneMapping=m,g=!0;let y=o,E=a;for(let L=0;L<A.length;L++){let C=A[L];C.enabled!==!1&&(C.render(w,E,y,R),C.needsSwap!==!1&&(y=E,E=E===a?l:a))}if(f!==w.outputColorSpace||b!==w.toneMapping){f=w.outputColorSpace,b=w.toneMapping,h.defines={},je.getTransfer(f)===ct&&(h.defines.SRGB_TRANSFER="");let L=ZM[b];L&&(h.defines[L]=""),h.needsUpdate=!0}h.uniforms.tDiffuse.value=y.texture,w.setRenderTarget(S),w.render(p,d),S=null,g=!1},this.isCompositing=function(){return g},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),l!==null&&l.dispose(),u.dispose(),h.dispose()}}var Db=new yn,Gb=new Ui(1,1),Vb=new Bo(1),Ob=new _o,kb=new Ol,Wb=new Io,gb=[],yb=[],bb=new Float32Array(16),xb=new Float32Array(9),vb=new Float32Array(4);function Ir(n,e,t){let i=n[0];if(i<=0||i>0)return n;let s=e*t,r=gb[s];if(r===void 0&&(r=new Float32Array(s),gb[s]=r),e!==0){i.toArray(r,0);for(let o=1,a=0;o!==e;++o)a+=t,n[o].toArray(r,a)}return r}function kt(n,e){if(n.length!==e.length)return!1;for(let t=0,i=n.length;t<i;t++)if(n[t]!==e[t])return!1;return!0}function Wt(n,e){for(let t=0,i=e.length;t<i;t++)n[t]=e[t]}function Qc(n,e){let t=yb[e];t===void 0&&(t=new Int32Array(e),yb[e]=t);for(let i=0;i!==e;++i)t[i]=n.allocateTextureUnit();return t}function YM(n,e){let t=this.cache;t[0]!==e&&(n.uniform1f(this.addr,e),t[0]=e)}function JM(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(n.uniform2f(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(kt(t,e))return;n.uniform2fv(this.addr,e),Wt(t,e)}}function QM(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(n.uniform3f(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else if(e.r!==void 0)(t[0]!==e.r||t[1]!==e.g||t[2]!==e.b)&&(n.uniform3f(this.addr,e.r,e.g,e.b),t[0]=e.r,t[1]=e.g,t[2]=e.b);else{if(kt(t,e))return;n.uniform3fv(this.addr,e),Wt(t,e)}}function KM(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(n.uniform4f(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(kt(t,e))return;n.uniform4fv(this.addr,e),Wt(t,e)}}function qM(n,e){let t=this.cache,i=e.elements;if(i===void 0){if(kt(t,e))return;n.uniformMatrix2fv(this.addr,!1,e),Wt(t,e)}else{if(kt(t,i))return;vb.set(i),n.uniformMatrix2fv(this.addr,!1,vb),Wt(t,i)}}function jM(n,e){let t=this.cache,i=e.elements;if(i===void 0){if(kt(t,e))return;n.uniformMatrix3fv(this.addr,!1,e),Wt(t,e)}else{if(kt(t,i))return;xb.set(i),n.uniformMatrix3fv(this.addr,!1,xb),Wt(t,i)}}function $M(n,e){let t=this.cache,i=e.elements;if(i===void 0){if(kt(t,e))return;n.uniformMatrix4fv(this.addr,!1,e),Wt(t,e)}else{if(kt(t,i))return;bb.set(i),n.uniformMatrix4fv(this.addr,!1,bb),Wt(t,i)}}function eR(n,e){let t=this.cache;t[0]!==e&&(n.uniform1i(this.addr,e),t[0]=e)}function tR(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(n.uniform2i(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(kt(t,e))return;n.uniform2iv(this.addr,e),Wt(t,e)}}function nR(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(n.uniform3i(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(kt(t,e))return;n.uniform3iv(this.addr,e),Wt(t,e)}}function iR(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(n.uniform4i(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(kt(t,e))return;n.uniform4iv(this.addr,e),Wt(t,e)}}function sR(n,e){let t=this.cache;t[0]!==e&&(n.uniform1ui(this.addr,e),t[0]=e)}function rR(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(n.uniform2ui(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(kt(t,e))return;n.uniform2uiv(this.addr,e),Wt(t,e)}}function oR(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(n.uniform3ui(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(kt(t,e))return;n.uniform3uiv(this.addr,e),Wt(t,e)}}function aR(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(n.uniform4ui(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(kt(t,e))return;n.uniform4uiv(this.addr,e),Wt(t,e)}}function Kc(n){return n.version===0&&(n.compareFunction=Th,n.needsUpdate=!0),n}function lR(n,e,t){let i=this.cache,s=t.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s);let r;this.type===n.SAMPLER_2D_SHADOW?r=Kc(Gb):r=Db,t.setTexture2D(e||r,s)}function cR(n,e,t){let i=this.cache,s=t.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s),t.setTexture3D(e||kb,s)}function uR(n,e,t){let i=this.cache,s=t.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s);let r;this.type===n.SAMPLER_CUBE_SHADOW?r=Kc(Vb):r=Wb,t.setTextureCube(e||r,s)}function dR(n,e,t){let i=this.cache,s=t.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s),t.setTexture2DArray(e||Ob,s)}function hR(n){switch(n){case 5126:return YM;case 35664:return JM;case 35665:return QM;case 35666:return KM;case 35674:return qM;case 35675:return jM;case 35676:return $M;case 5124:case 35670:return eR;case 35667:case 35671:return tR;case 35668:case 35672:return nR;case 35669:case 35673:return iR;case 5125:return sR;case 36294:return rR;case 36295:return oR;case 36296:return aR;case 35678:case 36198:case 36298:case 36306:case 35682:return lR;case 35679:case 36299:case 36307:return cR;case 35680:case 36300:case 36308:case 36293:return uR;case 36289:case 36303:case 36311:case 36292:return dR}}function pR(n,e){n.uniform1fv(this.addr,e)}function fR(n,e){let t=Ir(e,this.size,2);n.uniform2fv(this.addr,t)}function mR(n,e){let t=Ir(e,this.size,3);n.uniform3fv(this.addr,t)}function gR(n,e){let t=Ir(e,this.size,4);n.uniform4fv(this.addr,t)}function yR(n,e){let t=Ir(e,this.size,4);n.uniformMatrix2fv(this.addr,!1,t)}function bR(n,e){let t=Ir(e,this.size,9);n.uniformMatrix3fv(this.addr,!1,t)}function xR(n,e){let t=Ir(e,this.size,16);n.uniformMatrix4fv(this.addr,!1,t)}function vR(n,e){n.uniform1iv(this.addr,e)}function SR(n,e){n.uniform2iv(this.addr,e)}function _R(n,e){n.uniform3iv(this.addr,e)}function ER(n,e){n.uniform4iv(this.addr,e)}function AR(n,e){n.uniform1uiv(this.addr,e)}function MR(n,e){n.uniform2uiv(this.addr,e)}function RR(n,e){n.uniform3uiv(this.addr,e)}function wR(n,e){n.uniform4uiv(this.addr,e)}function TR(n,e,t){let i=this.cache,s=e.length,r=Qc(t,s);kt(i,r)||(n.uniform1iv(this.addr,r),Wt(i,r));let o;this.type===n.SAMPLER_2D_SHADOW?o=Kc(Gb):o=Db;for(let a=0;a!==s;++a)t.setTexture2D(e[a]||o,r[a])}function CR(n,e,t){let i=this.cache,s=e.length,r=Qc(t,s);kt(i,r)||(n.uniform1iv(this.addr,r),Wt(i,r));for(let o=0;o!==s;++o)t.setTexture3D(e[o]||kb,r[o])}function IR(n,e,t){let i=this.cache,s=e.length,r=Qc(t,s);kt(i,r)||(n.uniform1iv(this.addr,r),Wt(i,r));let o;this.type===n.SAMPLER_CUBE_SHADOW?o=Kc(Vb):o=Wb;for(let a=0;a!==s;++a)t.setTextureCube(e[a]||o,r[a])}function NR(n,e,t){let i=this.cache,s=e.length,r=Qc(t,s);kt(i,r)||(n.uniform1iv(this.addr,r),Wt(i,r));for(let o=0;o!==s;++o)t.setTexture2DArray(e[o]||Ob,r[o])}function BR(n){switch(n){case 5126:return pR;case 35664:return fR;case 35665:return mR;case 35666:return gR;case 35674:return yR;case 35675:return bR;case 35676:return xR;case 5124:case 35670:return vR;case 35667:case 35671:return SR;case 35668:case 35672:return _R;case 35669:case 35673:return ER;case 5125:return AR;case 36294:return MR;case 36295:return RR;case 36296:return wR;case 35678:case 36198:case 36298:case 36306:case 35682:return TR;case 35679:case 36299:case 36307:return CR;case 35680:case 36300:case 36308:case 36293:return IR;case 36289:case 36303:case 36311:case 36292:return NR}}var Oh=class{constructor(e,t,i){this.id=e,this.addr=i,this.cache=[],this.type=t.type,this.setValue=hR(t.type)}},kh=class{constructor(e,t,i){this.id=e,this.addr=i,this.cache=[],this.type=t.type,this.size=t.size,this.setValue=BR(t.type)}},Wh=class{constructor(e){this.id=e,this.seq=[],this.map={}}setValue(e,t,i){let s=this.seq;for(let r=0,o=s.length;r!==o;++r){let a=s[r];a.setValue(e,t[a.id],i)}}},Gh=/(\w+)(\])?(\[|\.)?/g;function Sb(n,e){n.seq.push(e),n.map[e.id]=e}function LR(n,e,t){let i=n.name,s=i.length;for(Gh.lastIndex=0;;){let r=Gh.exec(i),o=Gh.lastIndex,a=r[1],l=r[2]==="]",c=r[3];if(l&&(a=a|0),c===void 0||c==="["&&o+2===s){Sb(t,c===void 0?new Oh(a,n,e):new kh(a,n,e));break}else{let h=t.map[a];h===void 0&&(h=new Wh(a),Sb(t,h)),t=h}}}var Cr=class{constructor(e,t){this.seq=[],this.map={};let i=e.getProgramParameter(t,e.ACTIVE_UNIFORMS);for(let o=0;o<i;++o){let a=e.getActiveUniform(t,o),l=e.getUniformLocation(t,a.name);LR(a,l,this)}let s=[],r=[];for(let o of this.seq)o.type===e.SAMPLER_2D_SHADOW||o.type===e.SAMPLER_CUBE_SHADOW||o.type===e.SAMPLER_2D_ARRAY_SHADOW?s.push(o):r.push(o);s.length>0&&(this.seq=s.concat(r))}setValue(e,t,i,s){let r=this.map[t];r!==void 0&&r.setValue(e,i,s)}setOptional(e,t,i){let s=t[i];s!==void 0&&this.setValue(e,i,s)}static upload(e,t,i,s){for(let r=0,o=t.length;r!==o;++r){let a=t[r],l=i[a.id];l.needsUpdate!==!1&&a.setValue(e,l.value,s)}}static seqWithValue(e,t){let i=[];for(let s=0,r=e.length;s!==r;++s){let o=e[s];o.id in t&&i.push(o)}return i}};function _b(n,e,t){let i=n.createShader(e);return n.shaderSource(i,t),n.compileShader(i),i}var FR=37297,UR=0;function PR(n,e){let t=n.split(`
`),i=[],s=Math.max(e-6,0),r=Math.min(e+6,t.length);for(let o=s;o<r;o++){let a=o+1;i.push(`${a===e?">":" "} ${a}: ${t[o]}`)}return i.join(`
`)}var Eb=new De;function DR(n){je._getMatrix(Eb,je.workingColorSpace,n);let e=`mat3( ${Eb.elements.map(t=>t.toFixed(4))} )`;switch(je.getTransfer(n)){case vo:return[e,"LinearTransferOETF"];case ct:return[e,"sRGBTransferOETF"];default:return Ne("WebGLProgram: Unsupported color space: ",n),[e,"LinearTransferOETF"]}}function Ab(n,e,t){let i=n.getShaderParameter(e,n.COMPILE_STATUS),r=(n.getShaderInfoLog(e)||"").trim();if(i&&r==="")return"";let o=/ERROR: 0:(\d+)/.exec(r);if(o){let a=parseInt(o[1]);return t.toUpperCase()+`

`+r+`

`+PR(n.getShaderSource(e),a)}else return r}function GR(n,e){let t=DR(e);return[`vec4 ${n}( vec4 value ) {`,`	return ${t[1]}( vec4( ${t[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var VR={[hh]:"Linear",[ph]:"Reinhard",[fh]:"Cineon",[mh]:"ACESFilmic",[yh]:"AgX",[Ho]:"Neutral",[gh]:"Custom"};function OR(n,e){let t=VR[e];return t===void 0?(Ne("WebGLProgram: Unsupported toneMapping:",e),"vec3 "+n+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+n+"( vec3 color ) { return "+t+"ToneMapping( color ); }"}var Hc=new F;function kR(){je.getLuminanceCoefficients(Hc);let n=Hc.x.toFixed(4),e=Hc.y.toFixed(4),t=Hc.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${n}, ${e}, ${t} );`,"	return dot( weights, rgb );","}"].join(`
`)}function WR(n){return[n.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",n.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(na).join(`
`)}function zR(n){let e=[];for(let t in n){let i=n[t];i!==!1&&e.push("#define "+t+" "+i)}return e.join(`
`)}function XR(n,e){let t={},i=n.getProgramParameter(e,n.ACTIVE_ATTRIBUTES);for(let s=0;s<i;s++){let r=n.getActiveAttrib(e,s),o=r.name,a=1;r.type===n.FLOAT_MAT2&&(a=2),r.type===n.FLOAT_MAT3&&(a=3),r.type===n.FLOAT_MAT4&&(a=4),t[o]={type:r.type,location:n.getAttribLocation(e,o),locationSize:a}}return t}function na(n){return n!==""}function Mb(n,e){let t=e.numSpotLightShadows+e.numSpotLightMaps-e.numSpotLightShadowsWithMaps;return n.replace(/NUM_SUN_LIGHTS/g,e.numSunLights).replace(/NUM_DIR_LIGHTS/g,e.numDirLights).replace(/NUM_SPOT_LIGHTS/g,e.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,e.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,t).replace(/NUM_RECT_AREA_LIGHTS/g,e.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,e.numPointLights).replace(/NUM_HEMI_LIGHTS/g,e.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,e.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,e.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,e.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,e.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,e.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,e.numLightProbeGrids)}function Rb(n,e){return n.replace(/NUM_CLIPPING_PLANES/g,e.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,e.numClippingPlanes-e.numClipIntersection)}var ZR=/^[ \t]*#include +<([\w\d./]+)>/gm;function zh(n){return n.replace(ZR,HR)}function HR(n,e){let t=He[e];if(t===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+e+">");return zh(t)}var YR=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function wb(n){return n.replace(YR,JR)}function JR(n,e,t,i){let s="";for(let r=parseInt(e);r<parseInt(t);r++)s+=i.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function Tb(n){let e=`precision ${n.precision} float;
	precision ${n.precision} int;
	precision ${n.precision} sampler2D;
	precision ${n.precision} samplerCube;
	precision ${n.precision} sampler3D;
	precision ${n.precision} sampler2DArray;
	precision ${n.precision} sampler2DShadow;
	precision ${n.precision} samplerCubeShadow;
	precision ${n.precision} sampler2DArrayShadow;
	precision ${n.precision} isampler2D;
	precision ${n.precision} isampler3D;
	precision ${n.precision} isamplerCube;
	precision ${n.precision} isampler2DArray;
	precision ${n.precision} usampler2D;
	precision ${n.precision} usampler3D;
	precision ${n.precision} usamplerCube;
	precision ${n.precision} usampler2DArray;
	`;return n.precision==="highp"?e+=`
#define HIGH_PRECISION`:n.precision==="mediump"?e+=`
#define MEDIUM_PRECISION`:n.precision==="lowp"&&(e+=`
#define LOW_PRECISION`),e}var QR={[Ms]:"SHADOWMAP_TYPE_PCF",[Mr]:"SHADOWMAP_TYPE_VSM"};function KR(n){return QR[n.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var qR={[wr]:"ENVMAP_MODE_REFRACTION"};function jR(n){return n.envMap===!1?"ENVMAP_MODE_REFLECTION":qR[n.envMapMode]||"ENVMAP_MODE_REFLECTION"}var $R={[rc]:"ENVMAP_BLENDING_MULTIPLY",[zy]:"ENVMAP_BLENDING_MIX",[Xy]:"ENVMAP_BLENDING_ADD"};function ew(n){return n.envMap===!1?"ENVMAP_BLENDING_NONE":$R[n.combine]||"ENVMAP_BLENDING_NONE"}function tw(n,e,t,i){let s=n.getContext(),r=t.defines,o=t.vertexShader,a=t.fragmentShader,l=KR(t),c=t.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",u=jR(t),h=ew(t),p=WR(t),d=zR(r),f=s.createProgram(),b,g,m=t.glslVersion?"#version "+t.glslVersion+`
`:"";t.isRawShaderMaterial?(b=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,d].filter(na).join(`
`),b.length>0&&(b+=`
`),g=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,d].filter(na).join(`
`),g.length>0&&(g+=`
`)):(b=[Tb(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,d,t.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",t.batching?"#define USE_BATCHING":"",t.batchingColor?"#define USE_BATCHING_COLOR":"",t.instancing?"#define USE_INSTANCING":"",t.instancingColor?"#define USE_INSTANCING_COLOR":"",t.instancingMorph?"#define USE_INSTANCING_MORPH":"",t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.map?"#define USE_MAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+u:"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.displacementMap?"#define USE_DISPLACEMENTMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.mapUv?"#define MAP_UV "+t.mapUv:"",t.alphaMapUv?"#define ALPHAMAP_UV "+t.alphaMapUv:"",t.lightMapUv?"#define LIGHTMAP_UV "+t.lightMapUv:"",t.aoMapUv?"#define AOMAP_UV "+t.aoMapUv:"",t.emissiveMapUv?"#define EMISSIVEMAP_UV "+t.emissiveMapUv:"",t.bumpMapUv?"#define BUMPMAP_UV "+t.bumpMapUv:"",t.normalMapUv?"#define NORMALMAP_UV "+t.normalMapUv:"",t.displacementMapUv?"#define DISPLACEMENTMAP_UV "+t.displacementMapUv:"",t.metalnessMapUv?"#define METALNESSMAP_UV "+t.metalnessMapUv:"",t.roughnessMapUv?"#define ROUGHNESSMAP_UV "+t.roughnessMapUv:"",t.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+t.anisotropyMapUv:"",t.clearcoatMapUv?"#define CLEARCOATMAP_UV "+t.clearcoatMapUv:"",t.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+t.clearcoatNormalMapUv:"",t.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+t.clearcoatRoughnessMapUv:"",t.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+t.diffuseRoughnessMapUv:"",t.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+t.iridescenceMapUv:"",t.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+t.iridescenceThicknessMapUv:"",t.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+t.sheenColorMapUv:"",t.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+t.sheenRoughnessMapUv:"",t.specularMapUv?"#define SPECULARMAP_UV "+t.specularMapUv:"",t.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+t.specularColorMapUv:"",t.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+t.specularIntensityMapUv:"",t.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+t.transmissionMapUv:"",t.thicknessMapUv?"#define THICKNESSMAP_UV "+t.thicknessMapUv:"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexNormals?"#define HAS_NORMAL":"",t.vertexColors?"#define USE_COLOR":"",t.vertexAlphas?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.flatShading?"#define FLAT_SHADED":"",t.skinning?"#define USE_SKINNING":"",t.morphTargets?"#define USE_MORPHTARGETS":"",t.morphNormals&&t.flatShading===!1?"#define USE_MORPHNORMALS":"",t.morphColors?"#define USE_MORPHCOLORS":"",t.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+t.morphTextureStride:"",t.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+t.morphTargetsCount:"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+l:"",t.sizeAttenuation?"#define USE_SIZEATTENUATION":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(na).join(`
`),g=[Tb(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,d,t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",t.map?"#define USE_MAP":"",t.matcap?"#define USE_MATCAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+c:"",t.envMap?"#define "+u:"",t.envMap?"#define "+h:"",t.envMapPMREM?"#define ENVMAP_MAX_LOD "+t.envMapMaxLod+".0":"",t.envMapPMREM?"#define ENVMAP_SIZE "+t.envMapSize+".0":"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoat?"#define USE_CLEARCOAT":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.dispersion?"#define USE_DISPERSION":"",t.retroreflection?"#define USE_RETROREFLECTION":"",t.iridescence?"#define USE_IRIDESCENCE":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaTest?"#define USE_ALPHATEST":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.sheen?"#define USE_SHEEN":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexColors||t.instancingColor?"#define USE_COLOR":"",t.vertexAlphas||t.batchingColor?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.gradientMap?"#define USE_GRADIENTMAP":"",t.flatShading?"#define FLAT_SHADED":"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+l:"",t.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",t.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",t.toneMapping!==xi?"#define TONE_MAPPING":"",t.toneMapping!==xi?He.tonemapping_pars_fragment:"",t.toneMapping!==xi?OR("toneMapping",t.toneMapping):"",t.dithering?"#define DITHERING":"",t.opaque?"#define OPAQUE":"",He.colorspace_pars_fragment,GR("linearToOutputTexel",t.outputColorSpace),kR(),t.useDepthPacking?"#define DEPTH_PACKING "+t.depthPacking:"",`
`].filter(na).join(`
`)),o=zh(o),o=Mb(o,t),o=Rb(o,t),a=zh(a),a=Mb(a,t),a=Rb(a,t),o=wb(o),a=wb(a),t.isRawShaderMaterial!==!0&&(m=`#version 300 es
`,b=[p,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+b,g=["#define varying in",t.glslVersion===Ch?"":"layout(location = 0) out highp vec4 pc_fragColor;",t.glslVersion===Ch?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+g);let S=m+b+o,A=m+g+a,_=_b(s,s.VERTEX_SHADER,S),w=_b(s,s.FRAGMENT_SHADER,A);s.attachShader(f,_),s.attachShader(f,w),t.index0AttributeName!==void 0?s.bindAttribLocation(f,0,t.index0AttributeName):t.hasPositionAttribute===!0&&s.bindAttribLocation(f,0,"position"),s.linkProgram(f);function R(C){if(n.debug.checkShaderErrors){let P=s.getProgramInfoLog(f)||"",D=s.getShaderInfoLog(_)||"",W=s.getShaderInfoLog(w)||"",I=P.trim(),X=D.trim(),Y=W.trim(),z=!0,ne=!0;if(s.getProgramParameter(f,s.LINK_STATUS)===!1)if(z=!1,typeof n.debug.onShaderError=="function")n.debug.onShaderError(s,f,_,w);else{let H=Ab(s,_,"vertex"),$=Ab(s,w,"fragment");Pe("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(f,s.VALIDATE_STATUS)+`

Material Name: `+C.name+`
Material Type: `+C.type+`

Program Info Log: `+I+`
`+H+`
`+$)}else I!==""?Ne("WebGLProgram: Program Info Log:",I):(X===""||Y==="")&&(ne=!1);ne&&(C.diagnostics={runnable:z,programLog:I,vertexShader:{log:X,prefix:b},fragmentShader:{log:Y,prefix:g}})}s.deleteShader(_),s.deleteShader(w),y=new Cr(s,f),E=XR(s,f)}let y;this.getUniforms=function(){return y===void 0&&R(this),y};let E;this.getAttributes=function(){return E===void 0&&R(this),E};let L=t.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return L===!1&&(L=s.getProgramParameter(f,FR)),L},this.destroy=function(){i.releaseStatesOfProgram(this),s.deleteProgram(f),this.program=void 0},this.type=t.shaderType,this.name=t.shaderName,this.id=UR++,this.cacheKey=e,this.usedTimes=1,this.program=f,this.vertexShader=_,this.fragmentShader=w,this}var nw=0,Xh=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(e,t,i){let s=this._getShaderCacheForMaterial(e);return s.has(t)===!1&&(s.add(t),t.usedTimes++),s.has(i)===!1&&(s.add(i),i.usedTimes++),this}remove(e){let t=this.materialCache.get(e);for(let i of t)i.usedTimes--,i.usedTimes===0&&this.shaderCache.delete(i.code);return this.materialCache.delete(e),this}getVertexShaderStage(e){return this._getShaderStage(e.vertexShader)}getFragmentShaderStage(e){return this._getShaderStage(e.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(e){let t=this.materialCache,i=t.get(e);return i===void 0&&(i=new Set,t.set(e,i)),i}_getShaderStage(e){let t=this.shaderCache,i=t.get(e);return i===void 0&&(i=new Zh(e),t.set(e,i)),i}},Zh=class{constructor(e){this.id=nw++,this.code=e,this.usedTimes=0}};function iw(n){return n===os||n===jo||n===$o}function sw(n,e,t,i,s,r){let o=new xr,a=new Xh,l=new Set,c=[],u=new Map,h=i.logarithmicDepthBuffer,p={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function d(y){return l.add(y),y===0?"uv":`uv${y}`}function f(y,E,L,C,P,D){let W=C.fog,I=P.geometry,X=y.isMeshStandardMaterial||y.isMeshLambertMaterial||y.isMeshPhongMaterial?C.environment:null,Y=y.isMeshStandardMaterial||y.isMeshLambertMaterial&&!y.envMap||y.isMeshPhongMaterial&&!y.envMap,z=e.get(y.envMap||X,Y),ne=p[y.type],H=i.precision;y.precision!==null&&(H=i.getMaxPrecision(y.precision),H!==y.precision&&Ne("WebGLProgram.getParameters:",y.precision,"not supported, using",H,"instead."));let $=I.morphAttributes.position||I.morphAttributes.normal||I.morphAttributes.color,ee=$!==void 0?$.length:0,Me=0;I.morphAttributes.position!==void 0&&(Me=1),I.morphAttributes.normal!==void 0&&(Me=2),I.morphAttributes.color!==void 0&&(Me=3);let Oe,K,ye,Se;if(ne){let me=Si[ne];Oe=me.vertexShader,K=me.fragmentShader}else{Oe=y.vertexShader,K=y.fragmentShader;let me=a.getVertexShaderStage(y),ht=a.getFragmentShaderStage(y);a.update(y,me,ht),ye=me.id,Se=ht.id}let Le=n.getRenderTarget(),be=n.state.buffers.depth.getReversed(),ze=P.isInstancedMesh===!0,Nt=P.isBatchedMesh===!0,Ue=!!y.map,dt=!!y.matcap,gt=!!z,Qe=gt&&z.isPMREMTexture===!0,Kt=!!y.aoMap,Dt=!!y.lightMap,Sn=!!y.bumpMap&&y.wireframe===!1,Rt=!!y.normalMap,di=!!y.displacementMap,Xt=!!y.emissiveMap,Un=!!y.metalnessMap,Pn=!!y.roughnessMap,Dn=y.anisotropy>0,U=y.clearcoat>0,Gn=y.diffuseRoughness>0,_t=y.dispersion>0,Et=y.retroreflectivity>0,fe=y.iridescence>0,Gt=y.sheen>0,Fe=y.transmission>0,Ge=Dn&&!!y.anisotropyMap,M=U&&!!y.clearcoatMap,x=U&&!!y.clearcoatNormalMap,V=U&&!!y.clearcoatRoughnessMap,te=Gn&&!!y.diffuseRoughnessMap,j=fe&&!!y.iridescenceMap,ae=fe&&!!y.iridescenceThicknessMap,he=Gt&&!!y.sheenColorMap,J=Gt&&!!y.sheenRoughnessMap,Q=!!y.specularMap,ce=!!y.specularColorMap,T=!!y.specularIntensityMap,q=Fe&&!!y.transmissionMap,Z=Fe&&!!y.thicknessMap,ue=!!y.gradientMap,oe=!!y.alphaMap,le=y.alphaTest>0,we=!!y.alphaHash,Ze=!!y.extensions,ie=xi;y.toneMapped&&(Le===null||Le.isXRRenderTarget===!0)&&(ie=n.toneMapping);let Ce=Qe?z.isCompressedCubeTexture?z.image[0].mipmaps:z.mipmaps:null,Xe={shaderID:ne,shaderType:y.type,shaderName:y.name,vertexShader:Oe,fragmentShader:K,defines:y.defines,customVertexShaderID:ye,customFragmentShaderID:Se,isRawShaderMaterial:y.isRawShaderMaterial===!0,glslVersion:y.glslVersion,precision:H,batching:Nt,batchingColor:Nt&&P._colorsTexture!==null,instancing:ze,instancingColor:ze&&P.instanceColor!==null,instancingMorph:ze&&P.morphTexture!==null,outputColorSpace:Le===null?n.outputColorSpace:Le.isXRRenderTarget===!0?Le.texture.colorSpace:je.workingColorSpace,alphaToCoverage:!!y.alphaToCoverage,map:Ue,matcap:dt,envMap:gt,envMapMode:gt&&z.mapping,envMapPMREM:Qe,envMapMaxLod:Qe?Ce.length-1:null,envMapSize:Qe?Ce[0].width:null,aoMap:Kt,lightMap:Dt,bumpMap:Sn,normalMap:Rt,displacementMap:di,emissiveMap:Xt,normalMapObjectSpace:Rt&&y.normalMapType===Jy,normalMapTangentSpace:Rt&&y.normalMapType===ea,packedNormalMap:Rt&&y.normalMapType===ea&&iw(y.normalMap.format),metalnessMap:Un,roughnessMap:Pn,anisotropy:Dn,anisotropyMap:Ge,clearcoat:U,clearcoatMap:M,clearcoatNormalMap:x,clearcoatRoughnessMap:V,diffuseRoughness:Gn,diffuseRoughnessMap:te,dispersion:_t,retroreflection:Et,iridescence:fe,iridescenceMap:j,iridescenceThicknessMap:ae,sheen:Gt,sheenColorMap:he,sheenRoughnessMap:J,specularMap:Q,specularColorMap:ce,specularIntensityMap:T,transmission:Fe,transmissionMap:q,thicknessMap:Z,gradientMap:ue,opaque:y.transparent===!1&&y.blending===Rr&&y.alphaToCoverage===!1,alphaMap:oe,alphaTest:le,alphaHash:we,combine:y.combine,mapUv:Ue&&d(y.map.channel),aoMapUv:Kt&&d(y.aoMap.channel),lightMapUv:Dt&&d(y.lightMap.channel),bumpMapUv:Sn&&d(y.bumpMap.channel),normalMapUv:Rt&&d(y.normalMap.channel),displacementMapUv:di&&d(y.displacementMap.channel),emissiveMapUv:Xt&&d(y.emissiveMap.channel),metalnessMapUv:Un&&d(y.metalnessMap.channel),roughnessMapUv:Pn&&d(y.roughnessMap.channel),anisotropyMapUv:Ge&&d(y.anisotropyMap.channel),clearcoatMapUv:M&&d(y.clearcoatMap.channel),clearcoatNormalMapUv:x&&d(y.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:V&&d(y.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:te&&d(y.diffuseRoughnessMap.channel),iridescenceMapUv:j&&d(y.iridescenceMap.channel),iridescenceThicknessMapUv:ae&&d(y.iridescenceThicknessMap.channel),sheenColorMapUv:he&&d(y.sheenColorMap.channel),sheenRoughnessMapUv:J&&d(y.sheenRoughnessMap.channel),specularMapUv:Q&&d(y.specularMap.channel),specularColorMapUv:ce&&d(y.specularColorMap.channel),specularIntensityMapUv:T&&d(y.specularIntensityMap.channel),transmissionMapUv:q&&d(y.transmissionMap.channel),thicknessMapUv:Z&&d(y.thicknessMap.channel),alphaMapUv:oe&&d(y.alphaMap.channel),vertexTangents:!!I.attributes.tangent&&(Rt||Dn),vertexNormals:!!I.attributes.normal,vertexColors:y.vertexColors,vertexAlphas:y.vertexColors===!0&&!!I.attributes.color&&I.attributes.color.itemSize===4,pointsUvs:P.isPoints===!0&&!!I.attributes.uv&&(Ue||oe),fog:!!W,useFog:y.fog===!0,fogExp2:!!W&&W.isFogExp2,flatShading:y.wireframe===!1&&(y.flatShading===!0||I.attributes.normal===void 0&&Rt===!1&&(y.isMeshLambertMaterial||y.isMeshPhongMaterial||y.isMeshStandardMaterial||y.isMeshPhysicalMaterial)),sizeAttenuation:y.sizeAttenuation===!0,logarithmicDepthBuffer:h,reversedDepthBuffer:be,skinning:P.isSkinnedMesh===!0,hasPositionAttribute:I.attributes.position!==void 0,morphTargets:I.morphAttributes.position!==void 0,morphNormals:I.morphAttributes.normal!==void 0,morphColors:I.morphAttributes.color!==void 0,morphTargetsCount:ee,morphTextureStride:Me,numSunLights:E.sun.length,numDirLights:E.directional.length,numPointLights:E.point.length,numSpotLights:E.spot.length,numSpotLightMaps:E.spotLightMap.length,numRectAreaLights:E.rectArea.length,numHemiLights:E.hemi.length,numSunLightShadows:E.sunShadowMap.length,numDirLightShadows:E.directionalShadowMap.length,numPointLightShadows:E.pointShadowMap.length,numSpotLightShadows:E.spotShadowMap.length,numSpotLightShadowsWithMaps:E.numSpotLightShadowsWithMaps,numLightProbes:E.numLightProbes,numLightProbeGrids:D.filter(me=>me.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:y.dithering,shadowMapEnabled:n.shadowMap.enabled&&L.length>0,shadowMapType:n.shadowMap.type,toneMapping:ie,decodeVideoTexture:Ue&&y.map.isVideoTexture===!0&&je.getTransfer(y.map.colorSpace)===ct,decodeVideoTextureEmissive:Xt&&y.emissiveMap.isVideoTexture===!0&&je.getTransfer(y.emissiveMap.colorSpace)===ct,premultipliedAlpha:y.premultipliedAlpha,doubleSided:y.side===xn,flipSided:y.side===bn,useDepthPacking:y.depthPacking>=0,depthPacking:y.depthPacking||0,index0AttributeName:y.index0AttributeName,extensionClipCullDistance:Ze&&y.extensions.clipCullDistance===!0&&t.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(Ze&&y.extensions.multiDraw===!0||Nt)&&t.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:t.has("KHR_parallel_shader_compile"),customProgramCacheKey:y.customProgramCacheKey()};return Xe.vertexUv1s=l.has(1),Xe.vertexUv2s=l.has(2),Xe.vertexUv3s=l.has(3),l.clear(),Xe}function b(y){let E=[];if(y.shaderID?E.push(y.shaderID):(E.push(y.customVertexShaderID),E.push(y.customFragmentShaderID)),y.defines!==void 0)for(let L in y.defines)E.push(L),E.push(y.defines[L]);return y.isRawShaderMaterial===!1&&(g(E,y),m(E,y),E.push(n.outputColorSpace)),E.push(y.customProgramCacheKey),E.join()}function g(y,E){y.push(E.precision),y.push(E.outputColorSpace),y.push(E.envMapMode),y.push(E.envMapPMREM),y.push(E.envMapMaxLod),y.push(E.envMapSize),y.push(E.mapUv),y.push(E.alphaMapUv),y.push(E.lightMapUv),y.push(E.aoMapUv),y.push(E.bumpMapUv),y.push(E.normalMapUv),y.push(E.displacementMapUv),y.push(E.emissiveMapUv),y.push(E.metalnessMapUv),y.push(E.roughnessMapUv),y.push(E.anisotropyMapUv),y.push(E.clearcoatMapUv),y.push(E.clearcoatNormalMapUv),y.push(E.clearcoatRoughnessMapUv),y.push(E.diffuseRoughnessMapUv),y.push(E.iridescenceMapUv),y.push(E.iridescenceThicknessMapUv),y.push(E.sheenColorMapUv),y.push(E.sheenRoughnessMapUv),y.push(E.specularMapUv),y.push(E.specularColorMapUv),y.push(E.specularIntensityMapUv),y.push(E.transmissionMapUv),y.push(E.thicknessMapUv),y.push(E.combine),y.push(E.fogExp2),y.push(E.sizeAttenuation),y.push(E.morphTargetsCount),y.push(E.numSunLights),y.push(E.numDirLights),y.push(E.numPointLights),y.push(E.numSpotLights),y.push(E.numSpotLightMaps),y.push(E.numHemiLights),y.push(E.numRectAreaLights),y.push(E.numSunLightShadows),y.push(E.numDirLightShadows),y.push(E.numPointLightShadows),y.push(E.numSpotLightShadows),y.push(E.numSpotLightShadowsWithMaps),y.push(E.numLightProbes),y.push(E.numLightProbeGrids),y.push(E.shadowMapType),y.push(E.toneMapping),y.push(E.numClippingPlanes),y.push(E.numClipIntersection),y.push(E.depthPacking)}function m(y,E){o.disableAll(),E.instancing&&o.enable(0),E.instancingColor&&o.enable(1),E.instancingMorph&&o.enable(2),E.matcap&&o.enable(3),E.envMap&&o.enable(4),E.normalMapObjectSpace&&o.enable(5),E.normalMapTangentSpace&&o.enable(6),E.clearcoat&&o.enable(7),E.iridescence&&o.enable(8),E.alphaTest&&o.enable(9),E.vertexColors&&o.enable(10),E.vertexAlphas&&o.enable(11),E.vertexUv1s&&o.enable(12),E.vertexUv2s&&o.enable(13),E.vertexUv3s&&o.enable(14),E.vertexTangents&&o.enable(15),E.anisotropy&&o.enable(16),E.alphaHash&&o.enable(17),E.batching&&o.enable(18),E.dispersion&&o.enable(19),E.retroreflection&&o.enable(24),E.diffuseRoughness&&o.enable(25),E.batchingColor&&o.enable(20),E.gradientMap&&o.enable(21),E.packedNormalMap&&o.enable(22),E.vertexNormals&&o.enable(23),y.push(o.mask),o.disableAll(),E.fog&&o.enable(0),E.useFog&&o.enable(1),E.flatShading&&o.enable(2),E.logarithmicDepthBuffer&&o.enable(3),E.reversedDepthBuffer&&o.enable(4),E.skinning&&o.enable(5),E.morphTargets&&o.enable(6),E.morphNormals&&o.enable(7),E.morphColors&&o.enable(8),E.premultipliedAlpha&&o.enable(9),E.shadowMapEnabled&&o.enable(10),E.doubleSided&&o.enable(11),E.flipSided&&o.enable(12),E.useDepthPacking&&o.enable(13),E.dithering&&o.enable(14),E.transmission&&o.enable(15),E.sheen&&o.enable(16),E.opaque&&o.enable(17),E.pointsUvs&&o.enable(18),E.decodeVideoTexture&&o.enable(19),E.decodeVideoTextureEmissive&&o.enable(20),E.alphaToCoverage&&o.enable(21),E.numLightProbeGrids>0&&o.enable(22),E.hasPositionAttribute&&o.enable(23),y.push(o.mask)}function S(y){let E=p[y.type],L;if(E){let C=Si[E];L=cb.clone(C.uniforms)}else L=y.uniforms;return L}function A(y,E){let L=u.get(E);return L!==void 0?++L.usedTimes:(L=new tw(n,E,y,s),c.push(L),u.set(E,L)),L}function _(y){if(--y.usedTimes===0){let E=c.indexOf(y);c[E]=c[c.length-1],c.pop(),u.delete(y.cacheKey),y.destroy()}}function w(y){a.remove(y)}function R(){a.dispose()}return{getParameters:f,getProgramCacheKey:b,getUniforms:S,acquireProgram:A,releaseProgram:_,releaseShaderCache:w,programs:c,dispose:R}}function rw(){let n=new WeakMap;function e(o){return n.has(o)}function t(o){let a=n.get(o);return a===void 0&&(a={},n.set(o,a)),a}function i(o){n.delete(o)}function s(o,a,l){n.get(o)[a]=l}function r(){n=new WeakMap}return{has:e,get:t,remove:i,update:s,dispose:r}}function ow(n,e){return n.groupOrder!==e.groupOrder?n.groupOrder-e.groupOrder:n.renderOrder!==e.renderOrder?n.renderOrder-e.renderOrder:n.material.id!==e.material.id?n.material.id-e.material.id:n.materialVariant!==e.materialVariant?n.materialVariant-e.materialVariant:n.z!==e.z?n.z-e.z:n.id-e.id}function Cb(n,e){return n.groupOrder!==e.groupOrder?n.groupOrder-e.groupOrder:n.renderOrder!==e.renderOrder?n.renderOrder-e.renderOrder:n.z!==e.z?e.z-n.z:n.id-e.id}function Ib(){let n=[],e=0,t=[],i=[],s=[];function r(){e=0,t.length=0,i.length=0,s.length=0}function o(p){let d=0;return p.isInstancedMesh&&(d+=2),p.isSkinnedMesh&&(d+=1),d}function a(p,d,f,b,g,m){let S=n[e];return S===void 0?(S={id:p.id,object:p,geometry:d,material:f,materialVariant:o(p),groupOrder:b,renderOrder:p.renderOrder,z:g,group:m},n[e]=S):(S.id=p.id,S.object=p,S.geometry=d,S.material=f,S.materialVariant=o(p),S.groupOrder=b,S.renderOrder=p.renderOrder,S.z=g,S.group=m),e++,S}function l(p,d,f,b,g,m,S){S.reversedDepth===!0&&(g=-g);let A=a(p,d,f,b,g,m);f.transmission>0?i.push(A):f.transparent===!0?s.push(A):t.push(A)}function c(p,d,f,b,g,m){let S=a(p,d,f,b,g,m);f.transmission>0?i.unshift(S):f.transparent===!0?s.unshift(S):t.unshift(S)}function u(p,d){t.length>1&&t.sort(p||ow),i.length>1&&i.sort(d||Cb),s.length>1&&s.sort(d||Cb)}function h(){for(let p=e,d=n.length;p<d;p++){let f=n[p];if(f.id===null)break;f.id=null,f.object=null,f.geometry=null,f.material=null,f.group=null}}return{opaque:t,transmissive:i,transparent:s,init:r,push:l,unshift:c,finish:h,sort:u}}function aw(){let n=new WeakMap;function e(i,s){let r=n.get(i),o;return r===void 0?(o=new Ib,n.set(i,[o])):s>=r.length?(o=new Ib,r.push(o)):o=r[s],o}function t(){n=new WeakMap}return{get:e,dispose:t}}function lw(){let n={};return{get:function(e){if(n[e.id]!==void 0)return n[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={direction:new F,color:new We};break;case"SpotLight":t={position:new F,direction:new F,color:new We,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":t={position:new F,color:new We,distance:0,decay:0};break;case"HemisphereLight":t={direction:new F,skyColor:new We,groundColor:new We};break;case"RectAreaLight":t={color:new We,position:new F,halfWidth:new F,halfHeight:new F};break}return n[e.id]=t,t}}}function cw(){let n={};return{get:function(e){if(n[e.id]!==void 0)return n[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Be};break;case"SpotLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Be};break;case"PointLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Be,shadowCameraNear:1,shadowCameraFar:1e3};break}return n[e.id]=t,t}}}var uw=0;function dw(n,e){return(e.castShadow?2:0)-(n.castShadow?2:0)+(e.map?1:0)-(n.map?1:0)}function hw(n){let e=new lw,t=cw(),i={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)i.probe.push(new F);let s=new F,r=new Ye,o=new Ye;function a(c){let u=0,h=0,p=0;for(let D=0;D<9;D++)i.probe[D].set(0,0,0);let d=0,f=0,b=0,g=0,m=0,S=0,A=0,_=0,w=0,R=0,y=0,E=0,L=0,C=0;c.sort(dw);for(let D=0,W=c.length;D<W;D++){let I=c[D],X=I.color,Y=I.intensity,z=I.distance,ne=null;if(I.shadow&&I.shadow.map&&(I.shadow.map.texture.format===os?ne=I.shadow.map.texture:ne=I.shadow.map.depthTexture||I.shadow.map.texture),I.isAmbientLight)u+=X.r*Y,h+=X.g*Y,p+=X.b*Y;else if(I.isLightProbe){for(let H=0;H<9;H++)i.probe[H].addScaledVector(I.sh.coefficients[H],Y);C++}else if(I.isSunLight){let H=e.get(I);if(H.color.copy(I.color).multiplyScalar(I.intensity),I.castShadow){let $=I.shadow,ee=t.get(I);ee.shadowIntensity=$.intensity,ee.shadowBias=$.bias,ee.shadowNormalBias=$.normalBias,ee.shadowRadius=$.radius,ee.shadowMapSize.copy($.mapSize).multiply($.getFrameExtents()),i.sunShadow[f]=ee,i.sunShadowMap[f]=ne;let Me=$.getViewportCount();for(let Oe=0;Oe<Me;Oe++)i.sunShadowMatrix[b+Oe]=$.getMatrix(Oe),i.sunShadowCascade[b+Oe]=$._cascadeData[Oe];b+=Me,f++}i.sun[d]=H,d++}else if(I.isDirectionalLight){let H=e.get(I);if(H.color.copy(I.color).multiplyScalar(I.intensity),I.castShadow){let $=I.shadow,ee=t.get(I);ee.shadowIntensity=$.intensity,ee.shadowBias=$.bias,ee.shadowNormalBias=$.normalBias,ee.shadowRadius=$.radius,ee.shadowMapSize=$.mapSize,i.directionalShadow[g]=ee,i.directionalShadowMap[g]=ne,i.directionalShadowMatrix[g]=I.shadow.matrix,w++}i.directional[g]=H,g++}else if(I.isSpotLight){let H=e.get(I);H.position.setFromMatrixPosition(I.matrixWorld),H.color.copy(X).multiplyScalar(Y),H.distance=z,H.coneCos=Math.cos(I.angle),H.penumbraCos=Math.cos(I.angle*(1-I.penumbra)),H.decay=I.decay,i.spot[S]=H;let $=I.shadow;if(I.map&&(i.spotLightMap[E]=I.map,E++,$.updateMatrices(I),I.castShadow&&L++),i.spotLightMatrix[S]=$.matrix,I.castShadow){let ee=t.get(I);ee.shadowIntensity=$.intensity,ee.shadowBias=$.bias,ee.shadowNormalBias=$.normalBias,ee.shadowRadius=$.radius,ee.shadowMapSize=$.mapSize,i.spotShadow[S]=ee,i.spotShadowMap[S]=ne,y++}S++}else if(I.isRectAreaLight){let H=e.get(I);H.color.copy(X).multiplyScalar(Y),H.halfWidth.set(I.width*.5,0,0),H.halfHeight.set(0,I.height*.5,0),i.rectArea[A]=H,A++}else if(I.isPointLight){let H=e.get(I);if(H.color.copy(I.color).multiplyScalar(I.intensity),H.distance=I.distance,H.decay=I.decay,I.castShadow){let $=I.shadow,ee=t.get(I);ee.shadowIntensity=$.intensity,ee.shadowBias=$.bias,ee.shadowNormalBias=$.normalBias,ee.shadowRadius=$.radius,ee.shadowMapSize=$.mapSize,ee.shadowCameraNear=$.camera.near,ee.shadowCameraFar=$.camera.far,i.pointShadow[m]=ee,i.pointShadowMap[m]=ne,i.pointShadowMatrix[m]=I.shadow.matrix,R++}i.point[m]=H,m++}else if(I.isHemisphereLight){let H=e.get(I);H.skyColor.copy(I.color).multiplyScalar(Y),H.groundColor.copy(I.groundColor).multiplyScalar(Y),i.hemi[_]=H,_++}}A>0&&(n.has("OES_texture_float_linear")===!0?(i.rectAreaLTC1=ge.LTC_FLOAT_1,i.rectAreaLTC2=ge.LTC_FLOAT_2):(i.rectAreaLTC1=ge.LTC_HALF_1,i.rectAreaLTC2=ge.LTC_HALF_2)),i.ambient[0]=u,i.ambient[1]=h,i.ambient[2]=p;let P=i.hash;(P.sunLength!==d||P.directionalLength!==g||P.pointLength!==m||P.spotLength!==S||P.rectAreaLength!==A||P.hemiLength!==_||P.numSunShadows!==f||P.numDirectionalShadows!==w||P.numPointShadows!==R||P.numSpotShadows!==y||P.numSpotMaps!==E||P.numLightProbes!==C)&&(i.sun.length=d,i.directional.length=g,i.spot.length=S,i.rectArea.length=A,i.point.length=m,i.hemi.length=_,i.sunShadow.length=f,i.sunShadowMap.length=f,i.sunShadowMatrix.length=b,i.sunShadowCascade.length=b,i.directionalShadow.length=w,i.directionalShadowMap.length=w,i.directionalShadowMatrix.length=w,i.pointShadow.length=R,i.pointShadowMap.length=R,i.pointShadowMatrix.length=R,i.spotShadow.length=y,i.spotShadowMap.length=y,i.spotLightMatrix.length=y+E-L,i.spotLightMap.length=E,i.numSpotLightShadowsWithMaps=L,i.numLightProbes=C,P.sunLength=d,P.directionalLength=g,P.pointLength=m,P.spotLength=S,P.rectAreaLength=A,P.hemiLength=_,P.numSunShadows=f,P.numDirectionalShadows=w,P.numPointShadows=R,P.numSpotShadows=y,P.numSpotMaps=E,P.numLightProbes=C,i.version=uw++)}function l(c,u){let h=0,p=0,d=0,f=0,b=0,g=0,m=u.matrixWorldInverse;for(let S=0,A=c.length;S<A;S++){let _=c[S];if(_.isSunLight){let w=i.sun[h];w.direction.setFromMatrixPosition(_.matrixWorld),w.direction.transformDirection(m),h++}else if(_.isDirectionalLight){let w=i.directional[p];w.direction.setFromMatrixPosition(_.matrixWorld),s.setFromMatrixPosition(_.target.matrixWorld),w.direction.sub(s),w.direction.transformDirection(m),p++}else if(_.isSpotLight){let w=i.spot[f];w.position.setFromMatrixPosition(_.matrixWorld),w.position.applyMatrix4(m),w.direction.setFromMatrixPosition(_.matrixWorld),s.setFromMatrixPosition(_.target.matrixWorld),w.direction.sub(s),w.direction.transformDirection(m),f++}else if(_.isRectAreaLight){let w=i.rectArea[b];w.position.setFromMatrixPosition(_.matrixWorld),w.position.applyMatrix4(m),o.identity(),r.copy(_.matrixWorld),r.premultiply(m),o.extractRotation(r),w.halfWidth.set(_.width*.5,0,0),w.halfHeight.set(0,_.height*.5,0),w.halfWidth.applyMatrix4(o),w.halfHeight.applyMatrix4(o),b++}else if(_.isPointLight){let w=i.point[d];w.position.setFromMatrixPosition(_.matrixWorld),w.position.applyMatrix4(m),d++}else if(_.isHemisphereLight){let w=i.hemi[g];w.direction.setFromMatrixPosition(_.matrixWorld),w.direction.transformDirection(m),g++}}}return{setup:a,setupView:l,state:i}}function Nb(n){let e=new hw(n),t=[],i=[],s=[];function r(h){u.camera=h,t.length=0,i.length=0,s.length=0}function o(h){h.isLightProbeGrid?s.push(h):t.push(h)}function a(h){i.push(h)}function l(){e.setup(t),s.sort((h,p)=>h.priority-p.priority||h.id-p.id)}function c(h){e.setupView(t,h)}let u={lightsArray:t,shadowsArray:i,lightProbeGridArray:s,camera:null,lights:e,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:u,setupLights:l,setupLightsView:c,pushLight:o,pushShadow:a}}function pw(n){let e=new WeakMap;function t(s,r=0){let o=e.get(s),a;return o===void 0?(a=new Nb(n),e.set(s,[a])):r>=o.length?(a=new Nb(n),o.push(a)):a=o[r],a}function i(){e=new WeakMap}return{get:t,dispose:i}}var fw=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,mw=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ).rg;
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ).r;
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( max( 0.0, squared_mean - mean * mean ) );
	gl_FragColor = vec4( mean, std_dev, 0.0, 1.0 );
}`,gw=[new F(1,0,0),new F(-1,0,0),new F(0,1,0),new F(0,-1,0),new F(0,0,1),new F(0,0,-1)],yw=[new F(0,-1,0),new F(0,-1,0),new F(0,0,1),new F(0,0,-1),new F(0,-1,0),new F(0,-1,0)],Bb=new Ye,ta=new F,Vh=new F;function bw(n,e,t){let i=new $i,s=new Be,r=new Be,o=new mt,a=new Zl,l=new Hl,c={},u=t.maxTextureSize,h={[rs]:bn,[bn]:rs,[xn]:xn},p=new bi({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new Be},radius:{value:4}},vertexShader:fw,fragmentShader:mw}),d=p.clone();d.defines.HORIZONTAL_PASS=1;let f=new Ot;f.setAttribute("position",new Xn(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let b=new Mt(f,p),g=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=Ms;let m=this.type;this.render=function(R,y,E){if(g.enabled===!1||g.autoUpdate===!1&&g.needsUpdate===!1||R.length===0)return;this.type===Ay&&(Ne("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=Ms);let L=n.getRenderTarget(),C=n.getActiveCubeFace(),P=n.getActiveMipmapLevel(),D=n.state;D.setBlending(Rs),D.buffers.depth.getReversed()===!0?D.buffers.color.setClear(0,0,0,0):D.buffers.color.setClear(1,1,1,1),D.buffers.depth.setTest(!0),D.setScissorTest(!1);let W=m!==this.type;W&&y.traverse(function(I){I.material&&(Array.isArray(I.material)?I.material.forEach(X=>X.needsUpdate=!0):I.material.needsUpdate=!0)});for(let I=0,X=R.length;I<X;I++){let Y=R[I],z=Y.shadow;if(z===void 0){Ne("WebGLShadowMap:",Y,"has no shadow.");continue}if(z.autoUpdate===!1&&z.needsUpdate===!1)continue;s.copy(z.mapSize);let ne=z.getFrameExtents();s.multiply(ne),r.copy(z.mapSize),(s.x>u||s.y>u)&&(s.x>u&&(r.x=Math.floor(u/ne.x),s.x=r.x*ne.x,z.mapSize.x=r.x),s.y>u&&(r.y=Math.floor(u/ne.y),s.y=r.y*ne.y,z.mapSize.y=r.y));let H=n.state.buffers.depth.getReversed();if(z.camera._reversedDepth=H,z.map===null||W===!0){if(z.map!==null&&(z.map.depthTexture!==null&&(z.map.depthTexture.dispose(),z.map.depthTexture=null),z.map.dispose()),this.type===Mr){if(Y.isPointLight){Ne("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}z.map=new Bn(s.x,s.y,{format:os,type:ui,minFilter:gn,magFilter:gn,generateMipmaps:!1}),z.map.texture.name=Y.name+".shadowMap",z.map.depthTexture=new Ui(s.x,s.y,Zn),z.map.depthTexture.name=Y.name+".shadowMapDepth",z.map.depthTexture.format=Fi,z.map.depthTexture.compareFunction=null,z.map.depthTexture.minFilter=Jt,z.map.depthTexture.magFilter=Jt}else Y.isPointLight?(z.map=new ia(s.x),z.map.depthTexture=new Bo(s.x,ci)):(z.map=new Bn(s.x,s.y),z.map.depthTexture=new Ui(s.x,s.y,ci)),z.map.depthTexture.name=Y.name+".shadowMap",z.map.depthTexture.format=Fi,this.type===Ms?(z.map.depthTexture.compareFunction=H?wh:Rh,z.map.depthTexture.minFilter=gn,z.map.depthTexture.magFilter=gn):(z.map.depthTexture.compareFunction=null,z.map.depthTexture.minFilter=Jt,z.map.depthTexture.magFilter=Jt);z.camera.updateProjectionMatrix()}z.map.isWebGLCubeRenderTarget!==!0&&(z.map.width!==s.x||z.map.height!==s.y)&&z.map.setSize(s.x,s.y);let $=z.map.isWebGLCubeRenderTarget?6:z.getViewportCount();Y.isPointLight!==!0&&z.updateMatrices(Y,E);let ee=(z.camera.layers.mask&4294967294)!==0?z.camera.layers:E.layers;for(let Me=0;Me<$;Me++){let Oe=z.getCamera(Me);if(Y.isPointLight){let K=z.camera,ye=z.matrix,Se=Y.distance||K.far;Se!==K.far&&(K.far=Se,K.updateProjectionMatrix()),ta.setFromMatrixPosition(Y.matrixWorld),K.position.copy(ta),Vh.copy(K.position),Vh.add(gw[Me]),K.up.copy(yw[Me]),K.lookAt(Vh),K.updateMatrixWorld(),ye.makeTranslation(-ta.x,-ta.y,-ta.z),Bb.multiplyMatrices(K.projectionMatrix,K.matrixWorldInverse),z._frustum.setFromProjectionMatrix(Bb,K.coordinateSystem,K.reversedDepth)}if(z.map.isWebGLCubeRenderTarget)n.setRenderTarget(z.map,Me),n.clear();else{Me===0&&(n.setRenderTarget(z.map),n.clear());let K=z.getViewport(Me);o.set(r.x*K.x,r.y*K.y,r.x*K.z,r.y*K.w),D.viewport(o)}i=z.getFrustum(Me),_(y,E,Oe,Y,ee,this.type)}z.isPointLightShadow!==!0&&this.type===Mr&&S(z,E),z.needsUpdate=!1}m=this.type,g.needsUpdate=!1,n.setRenderTarget(L,C,P)};function S(R,y){let E=e.update(b);p.defines.VSM_SAMPLES!==R.blurSamples&&(p.defines.VSM_SAMPLES=R.blurSamples,d.defines.VSM_SAMPLES=R.blurSamples,p.needsUpdate=!0,d.needsUpdate=!0),R.mapPass===null?R.mapPass=new Bn(s.x,s.y,{format:os,type:ui}):(R.mapPass.width!==R.map.width||R.mapPass.height!==R.map.height)&&R.mapPass.setSize(R.map.width,R.map.height),p.uniforms.shadow_pass.value=R.map.depthTexture,p.uniforms.resolution.value.set(R.map.width,R.map.height),p.uniforms.radius.value=R.radius,n.setRenderTarget(R.mapPass),n.clear(),n.renderBufferDirect(y,null,E,p,b,null),d.uniforms.shadow_pass.value=R.mapPass.texture,d.uniforms.resolution.value.set(R.map.width,R.map.height),d.uniforms.radius.value=R.radius,n.setRenderTarget(R.map),n.clear(),n.renderBufferDirect(y,null,E,d,b,null)}function A(R,y,E,L){let C=null,P=E.isPointLight===!0?R.customDistanceMaterial:R.customDepthMaterial;if(P!==void 0)C=P;else if(C=E.isPointLight===!0?l:a,n.localClippingEnabled&&y.clipShadows===!0&&Array.isArray(y.clippingPlanes)&&y.clippingPlanes.length!==0||y.displacementMap&&y.displacementScale!==0||y.alphaMap&&y.alphaTest>0||y.map&&y.alphaTest>0||y.alphaToCoverage===!0){let D=C.uuid,W=y.uuid,I=c[D];I===void 0&&(I={},c[D]=I);let X=I[W];X===void 0&&(X=C.clone(),I[W]=X,y.addEventListener("dispose",w)),C=X}if(C.visible=y.visible,C.wireframe=y.wireframe,L===Mr?C.side=y.shadowSide!==null?y.shadowSide:y.side:C.side=y.shadowSide!==null?y.shadowSide:h[y.side],C.alphaMap=y.alphaMap,C.alphaTest=y.alphaToCoverage===!0?.5:y.alphaTest,C.map=y.map,C.clipShadows=y.clipShadows,C.clippingPlanes=y.clippingPlanes,C.clipIntersection=y.clipIntersection,C.displacementMap=y.displacementMap,C.displacementScale=y.displacementScale,C.displacementBias=y.displacementBias,C.wireframeLinewidth=y.wireframeLinewidth,C.linewidth=y.linewidth,E.isPointLight===!0&&C.isMeshDistanceMaterial===!0){let D=n.properties.get(C);D.light=E}return C}function _(R,y,E,L,C,P){if(R.visible===!1)return;if(R.layers.test(C)&&(R.isMesh||R.isLine||R.isPoints)&&(R.castShadow||R.receiveShadow&&P===Mr)&&(!R.frustumCulled||R.intersectsFrustum(i))){R.modelViewMatrix.multiplyMatrices(E.matrixWorldInverse,R.matrixWorld);let I=e.update(R),X=R.material;if(Array.isArray(X)){let Y=I.groups;for(let z=0,ne=Y.length;z<ne;z++){let H=Y[z],$=X[H.materialIndex];if($&&$.visible){let ee=A(R,$,L,P);R.onBeforeShadow(n,R,y,E,I,ee,H),n.renderBufferDirect(E,null,I,ee,R,H),R.onAfterShadow(n,R,y,E,I,ee,H)}}}else if(X.visible){let Y=A(R,X,L,P);R.onBeforeShadow(n,R,y,E,I,Y,null),n.renderBufferDirect(E,null,I,Y,R,null),R.onAfterShadow(n,R,y,E,I,Y,null)}}let W=R.children;for(let I=0,X=W.length;I<X;I++)_(W[I],y,E,L,C,P)}function w(R){R.target.removeEventListener("dispose",w);for(let E in c){let L=c[E],C=R.target.uuid;C in L&&(L[C].dispose(),delete L[C])}}}function xw(n,e){function t(){let T=!1,q=new mt,Z=null,ue=new mt(0,0,0,0);return{setMask:function(oe){Z!==oe&&!T&&(n.colorMask(oe,oe,oe,oe),Z=oe)},setLocked:function(oe){T=oe},setClear:function(oe,le,we,Ze,ie){ie===!0&&(oe*=Ze,le*=Ze,we*=Ze),q.set(oe,le,we,Ze),ue.equals(q)===!1&&(n.clearColor(oe,le,we,Ze),ue.copy(q))},reset:function(){T=!1,Z=null,ue.set(-1,0,0,0)}}}function i(){let T=!1,q=!1,Z=null,ue=null,oe=null;return{setReversed:function(le){if(q!==le){let we=e.get("EXT_clip_control");le?we.clipControlEXT(we.LOWER_LEFT_EXT,we.ZERO_TO_ONE_EXT):we.clipControlEXT(we.LOWER_LEFT_EXT,we.NEGATIVE_ONE_TO_ONE_EXT),q=le;let Ze=oe;oe=null,this.setClear(Ze)}},getReversed:function(){return q},setTest:function(le){le?be(n.DEPTH_TEST):ze(n.DEPTH_TEST)},setMask:function(le){Z!==le&&!T&&(n.depthMask(le),Z=le)},setFunc:function(le){if(q&&(le=rb[le]),ue!==le){switch(le){case Cl:n.depthFunc(n.NEVER);break;case Il:n.depthFunc(n.ALWAYS);break;case Nl:n.depthFunc(n.LESS);break;case pr:n.depthFunc(n.LEQUAL);break;case Bl:n.depthFunc(n.EQUAL);break;case Ll:n.depthFunc(n.GEQUAL);break;case Fl:n.depthFunc(n.GREATER);break;case Ul:n.depthFunc(n.NOTEQUAL);break;default:n.depthFunc(n.LEQUAL)}ue=le}},setLocked:function(le){T=le},setClear:function(le){oe!==le&&(oe=le,q&&(le=1-le),n.clearDepth(le))},reset:function(){T=!1,Z=null,ue=null,oe=null,q=!1}}}function s(){let T=!1,q=null,Z=null,ue=null,oe=null,le=null,we=null,Ze=null,ie=null;return{setTest:function(Ce){T||(Ce?be(n.STENCIL_TEST):ze(n.STENCIL_TEST))},setMask:function(Ce){q!==Ce&&!T&&(n.stencilMask(Ce),q=Ce)},setFunc:function(Ce,Xe,me){(Z!==Ce||ue!==Xe||oe!==me)&&(n.stencilFunc(Ce,Xe,me),Z=Ce,ue=Xe,oe=me)},setOp:function(Ce,Xe,me){(le!==Ce||we!==Xe||Ze!==me)&&(n.stencilOp(Ce,Xe,me),le=Ce,we=Xe,Ze=me)},setLocked:function(Ce){T=Ce},setClear:function(Ce){ie!==Ce&&(n.clearStencil(Ce),ie=Ce)},reset:function(){T=!1,q=null,Z=null,ue=null,oe=null,le=null,we=null,Ze=null,ie=null}}}let r=new t,o=new i,a=new s,l={},c=new WeakMap,u={},h={},p={},d=new WeakMap,f=[],b=null,g=!1,m=null,S=null,A=null,_=null,w=null,R=null,y=null,E=new We(0,0,0),L=0,C=!1,P=null,D=null,W=null,I=null,X=null,Y=n.getParameter(n.MAX_COMBINED_TEXTURE_IMAGE_UNITS),z=!1,ne=0,H=n.getParameter(n.VERSION);H.indexOf("WebGL")!==-1?(ne=parseFloat(/^WebGL (\d)/.exec(H)[1]),z=ne>=1):H.indexOf("OpenGL ES")!==-1&&(ne=parseFloat(/^OpenGL ES (\d)/.exec(H)[1]),z=ne>=2);let $=null,ee={},Me=n.getParameter(n.SCISSOR_BOX),Oe=n.getParameter(n.VIEWPORT),K=new mt().fromArray(Me),ye=new mt().fromArray(Oe);function Se(T,q,Z,ue){let oe=new Uint8Array(4),le=n.createTexture();n.bindTexture(T,le),n.texParameteri(T,n.TEXTURE_MIN_FILTER,n.NEAREST),n.texParameteri(T,n.TEXTURE_MAG_FILTER,n.NEAREST);for(let we=0;we<Z;we++)T===n.TEXTURE_3D||T===n.TEXTURE_2D_ARRAY?n.texImage3D(q,0,n.RGBA,1,1,ue,0,n.RGBA,n.UNSIGNED_BYTE,oe):n.texImage2D(q+we,0,n.RGBA,1,1,0,n.RGBA,n.UNSIGNED_BYTE,oe);return le}let Le={};Le[n.TEXTURE_2D]=Se(n.TEXTURE_2D,n.TEXTURE_2D,1),Le[n.TEXTURE_CUBE_MAP]=Se(n.TEXTURE_CUBE_MAP,n.TEXTURE_CUBE_MAP_POSITIVE_X,6),Le[n.TEXTURE_2D_ARRAY]=Se(n.TEXTURE_2D_ARRAY,n.TEXTURE_2D_ARRAY,1,1),Le[n.TEXTURE_3D]=Se(n.TEXTURE_3D,n.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),be(n.DEPTH_TEST),o.setFunc(pr),Sn(!1),Rt(oh),be(n.CULL_FACE),Kt(Rs);function be(T){u[T]!==!0&&(n.enable(T),u[T]=!0)}function ze(T){u[T]!==!1&&(n.disable(T),u[T]=!1)}function Nt(T,q){return p[T]!==q?(n.bindFramebuffer(T,q),p[T]=q,T===n.DRAW_FRAMEBUFFER&&(p[n.FRAMEBUFFER]=q),T===n.FRAMEBUFFER&&(p[n.DRAW_FRAMEBUFFER]=q),!0):!1}function Ue(T,q){let Z=f,ue=!1;if(T){Z=d.get(q),Z===void 0&&(Z=[],d.set(q,Z));let oe=T.textures;if(Z.length!==oe.length||Z[0]!==n.COLOR_ATTACHMENT0){for(let le=0,we=oe.length;le<we;le++)Z[le]=n.COLOR_ATTACHMENT0+le;Z.length=oe.length,ue=!0}}else Z[0]!==n.BACK&&(Z[0]=n.BACK,ue=!0);ue&&n.drawBuffers(Z)}function dt(T){return b!==T?(n.useProgram(T),b=T,!0):!1}let gt={[ws]:n.FUNC_ADD,[Ry]:n.FUNC_SUBTRACT,[wy]:n.FUNC_REVERSE_SUBTRACT};gt[Ty]=n.MIN,gt[Cy]=n.MAX;let Qe={[Iy]:n.ZERO,[Ny]:n.ONE,[By]:n.SRC_COLOR,[uh]:n.SRC_ALPHA,[Gy]:n.SRC_ALPHA_SATURATE,[Py]:n.DST_COLOR,[Fy]:n.DST_ALPHA,[Ly]:n.ONE_MINUS_SRC_COLOR,[dh]:n.ONE_MINUS_SRC_ALPHA,[Dy]:n.ONE_MINUS_DST_COLOR,[Uy]:n.ONE_MINUS_DST_ALPHA,[Vy]:n.CONSTANT_COLOR,[Oy]:n.ONE_MINUS_CONSTANT_COLOR,[ky]:n.CONSTANT_ALPHA,[Wy]:n.ONE_MINUS_CONSTANT_ALPHA};function Kt(T,q,Z,ue,oe,le,we,Ze,ie,Ce){if(T===Rs){g===!0&&(ze(n.BLEND),g=!1);return}if(g===!1&&(be(n.BLEND),g=!0),T!==My){if(T!==m||Ce!==C){if((S!==ws||w!==ws)&&(n.blendEquation(n.FUNC_ADD),S=ws,w=ws),Ce)switch(T){case Rr:n.blendFuncSeparate(n.ONE,n.ONE_MINUS_SRC_ALPHA,n.ONE,n.ONE_MINUS_SRC_ALPHA);break;case ah:n.blendFunc(n.ONE,n.ONE);break;case lh:n.blendFuncSeparate(n.ZERO,n.ONE_MINUS_SRC_COLOR,n.ZERO,n.ONE);break;case ch:n.blendFuncSeparate(n.DST_COLOR,n.ONE_MINUS_SRC_ALPHA,n.ZERO,n.ONE);break;default:Pe("WebGLState: Invalid blending: ",T);break}else switch(T){case Rr:n.blendFuncSeparate(n.SRC_ALPHA,n.ONE_MINUS_SRC_ALPHA,n.ONE,n.ONE_MINUS_SRC_ALPHA);break;case ah:n.blendFuncSeparate(n.SRC_ALPHA,n.ONE,n.ONE,n.ONE);break;case lh:Pe("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case ch:Pe("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:Pe("WebGLState: Invalid blending: ",T);break}A=null,_=null,R=null,y=null,E.set(0,0,0),L=0,m=T,C=Ce}return}oe=oe||q,le=le||Z,we=we||ue,(q!==S||oe!==w)&&(n.blendEquationSeparate(gt[q],gt[oe]),S=q,w=oe),(Z!==A||ue!==_||le!==R||we!==y)&&(n.blendFuncSeparate(Qe[Z],Qe[ue],Qe[le],Qe[we]),A=Z,_=ue,R=le,y=we),(Ze.equals(E)===!1||ie!==L)&&(n.blendColor(Ze.r,Ze.g,Ze.b,ie),E.copy(Ze),L=ie),m=T,C=!1}function Dt(T,q){T.side===xn?ze(n.CULL_FACE):be(n.CULL_FACE);let Z=T.side===bn;q&&(Z=!Z),Sn(Z),T.blending===Rr&&T.transparent===!1?Kt(Rs):Kt(T.blending,T.blendEquation,T.blendSrc,T.blendDst,T.blendEquationAlpha,T.blendSrcAlpha,T.blendDstAlpha,T.blendColor,T.blendAlpha,T.premultipliedAlpha),o.setFunc(T.depthFunc),o.setTest(T.depthTest),o.setMask(T.depthWrite),r.setMask(T.colorWrite);let ue=T.stencilWrite;a.setTest(ue),ue&&(a.setMask(T.stencilWriteMask),a.setFunc(T.stencilFunc,T.stencilRef,T.stencilFuncMask),a.setOp(T.stencilFail,T.stencilZFail,T.stencilZPass)),Xt(T.polygonOffset,T.polygonOffsetFactor,T.polygonOffsetUnits),T.alphaToCoverage===!0?be(n.SAMPLE_ALPHA_TO_COVERAGE):ze(n.SAMPLE_ALPHA_TO_COVERAGE)}function Sn(T){P!==T&&(T?n.frontFace(n.CW):n.frontFace(n.CCW),P=T)}function Rt(T){T!==_y?(be(n.CULL_FACE),T!==D&&(T===oh?n.cullFace(n.BACK):T===Ey?n.cullFace(n.FRONT):n.cullFace(n.FRONT_AND_BACK))):ze(n.CULL_FACE),D=T}function di(T){T!==W&&(z&&n.lineWidth(T),W=T)}function Xt(T,q,Z){T?(be(n.POLYGON_OFFSET_FILL),(I!==q||X!==Z)&&(I=q,X=Z,o.getReversed()&&(q=-q,Z=-Z),n.polygonOffset(q,Z))):ze(n.POLYGON_OFFSET_FILL)}function Un(T){T?be(n.SCISSOR_TEST):ze(n.SCISSOR_TEST)}function Pn(T){T===void 0&&(T=n.TEXTURE0+Y-1),$!==T&&(n.activeTexture(T),$=T)}function Dn(T,q,Z){Z===void 0&&($===null?Z=n.TEXTURE0+Y-1:Z=$);let ue=ee[Z];ue===void 0&&(ue={type:void 0,texture:void 0},ee[Z]=ue),(ue.type!==T||ue.texture!==q)&&($!==Z&&(n.activeTexture(Z),$=Z),n.bindTexture(T,q||Le[T]),ue.type=T,ue.texture=q)}function U(){let T=ee[$];T!==void 0&&T.type!==void 0&&(n.bindTexture(T.type,null),T.type=void 0,T.texture=void 0)}function Gn(){try{n.compressedTexImage2D(...arguments)}catch(T){Pe("WebGLState:",T)}}function _t(){try{n.compressedTexImage3D(...arguments)}catch(T){Pe("WebGLState:",T)}}function Et(){try{n.texSubImage2D(...arguments)}catch(T){Pe("WebGLState:",T)}}function fe(){try{n.texSubImage3D(...arguments)}catch(T){Pe("WebGLState:",T)}}function Gt(){try{n.compressedTexSubImage2D(...arguments)}catch(T){Pe("WebGLState:",T)}}function Fe(){try{n.compressedTexSubImage3D(...arguments)}catch(T){Pe("WebGLState:",T)}}function Ge(){try{n.texStorage2D(...arguments)}catch(T){Pe("WebGLState:",T)}}function M(){try{n.texStorage3D(...arguments)}catch(T){Pe("WebGLState:",T)}}function x(){try{n.texImage2D(...arguments)}catch(T){Pe("WebGLState:",T)}}function V(){try{n.texImage3D(...arguments)}catch(T){Pe("WebGLState:",T)}}function te(T){return h[T]!==void 0?h[T]:n.getParameter(T)}function j(T,q){h[T]!==q&&(n.pixelStorei(T,q),h[T]=q)}function ae(T){K.equals(T)===!1&&(n.scissor(T.x,T.y,T.z,T.w),K.copy(T))}function he(T){ye.equals(T)===!1&&(n.viewport(T.x,T.y,T.z,T.w),ye.copy(T))}function J(T,q){let Z=c.get(q);Z===void 0&&(Z=new WeakMap,c.set(q,Z));let ue=Z.get(T);ue===void 0&&(ue=n.getUniformBlockIndex(q,T.name),n.uniformBlockBinding(q,ue,ue),Z.set(T,ue))}function Q(T,q,Z){let oe=c.get(q).get(T);l[oe]!==Z&&(n.bindBufferBase(n.UNIFORM_BUFFER,oe,Z),l[oe]=Z)}function ce(){n.disable(n.BLEND),n.disable(n.CULL_FACE),n.disable(n.DEPTH_TEST),n.disable(n.POLYGON_OFFSET_FILL),n.disable(n.SCISSOR_TEST),n.disable(n.STENCIL_TEST),n.disable(n.SAMPLE_ALPHA_TO_COVERAGE),n.blendEquation(n.FUNC_ADD),n.blendFunc(n.ONE,n.ZERO),n.blendFuncSeparate(n.ONE,n.ZERO,n.ONE,n.ZERO),n.blendColor(0,0,0,0),n.colorMask(!0,!0,!0,!0),n.clearColor(0,0,0,0),n.depthMask(!0),n.depthFunc(n.LESS),o.setReversed(!1),n.clearDepth(1),n.stencilMask(4294967295),n.stencilFunc(n.ALWAYS,0,4294967295),n.stencilOp(n.KEEP,n.KEEP,n.KEEP),n.clearStencil(0),n.cullFace(n.BACK),n.frontFace(n.CCW),n.polygonOffset(0,0),n.activeTexture(n.TEXTURE0),n.bindFramebuffer(n.FRAMEBUFFER,null),n.bindFramebuffer(n.DRAW_FRAMEBUFFER,null),n.bindFramebuffer(n.READ_FRAMEBUFFER,null),n.useProgram(null),n.lineWidth(1),n.scissor(0,0,n.canvas.width,n.canvas.height),n.viewport(0,0,n.canvas.width,n.canvas.height),n.pixelStorei(n.PACK_ALIGNMENT,4),n.pixelStorei(n.UNPACK_ALIGNMENT,4),n.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,!1),n.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),n.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,n.BROWSER_DEFAULT_WEBGL),n.pixelStorei(n.PACK_ROW_LENGTH,0),n.pixelStorei(n.PACK_SKIP_PIXELS,0),n.pixelStorei(n.PACK_SKIP_ROWS,0),n.pixelStorei(n.UNPACK_ROW_LENGTH,0),n.pixelStorei(n.UNPACK_IMAGE_HEIGHT,0),n.pixelStorei(n.UNPACK_SKIP_PIXELS,0),n.pixelStorei(n.UNPACK_SKIP_ROWS,0),n.pixelStorei(n.UNPACK_SKIP_IMAGES,0),u={},h={},$=null,ee={},p={},l={},d=new WeakMap,f=[],b=null,g=!1,m=null,S=null,A=null,_=null,w=null,R=null,y=null,E=new We(0,0,0),L=0,C=!1,P=null,D=null,W=null,I=null,X=null,K.set(0,0,n.canvas.width,n.canvas.height),ye.set(0,0,n.canvas.width,n.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:be,disable:ze,bindFramebuffer:Nt,drawBuffers:Ue,useProgram:dt,setBlending:Kt,setMaterial:Dt,setFlipSided:Sn,setCullFace:Rt,setLineWidth:di,setPolygonOffset:Xt,setScissorTest:Un,activeTexture:Pn,bindTexture:Dn,unbindTexture:U,compressedTexImage2D:Gn,compressedTexImage3D:_t,texImage2D:x,texImage3D:V,pixelStorei:j,getParameter:te,updateUBOMapping:J,uniformBlockBinding:Q,texStorage2D:Ge,texStorage3D:M,texSubImage2D:Et,texSubImage3D:fe,compressedTexSubImage2D:Gt,compressedTexSubImage3D:Fe,scissor:ae,viewport:he,reset:ce}}function vw(n,e,t,i,s,r,o){let a=e.has("WEBGL_multisampled_render_to_texture")?e.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new Be,u=new WeakMap,h=new Set,p,d=new WeakMap,f=new Set,b=new FinalizationRegistry(M=>f.delete(M)),g=!1;try{g=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function m(M,x){return g?new OffscreenCanvas(M,x):So("canvas")}function S(M,x,V){let te=1,j=Ge(M);if((j.width>V||j.height>V)&&(te=V/Math.max(j.width,j.height)),te<1)if(typeof HTMLImageElement<"u"&&M instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&M instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&M instanceof ImageBitmap||typeof VideoFrame<"u"&&M instanceof VideoFrame){let ae=Math.floor(te*j.width),he=Math.floor(te*j.height);p===void 0&&(p=m(ae,he));let J=x?m(ae,he):p;return J.width=ae,J.height=he,J.getContext("2d").drawImage(M,0,0,ae,he),Ne("WebGLRenderer: Texture has been resized from ("+j.width+"x"+j.height+") to ("+ae+"x"+he+")."),J}else return"data"in M&&Ne("WebGLRenderer: Image in DataTexture is too big ("+j.width+"x"+j.height+")."),M;return M}function A(M){return M.generateMipmaps}function _(M){n.generateMipmap(M)}function w(M){return M.isWebGLCubeRenderTarget?n.TEXTURE_CUBE_MAP:M.isWebGL3DRenderTarget?n.TEXTURE_3D:M.isWebGLArrayRenderTarget||M.isCompressedArrayTexture?n.TEXTURE_2D_ARRAY:n.TEXTURE_2D}function R(M,x,V,te,j,ae=!1){if(M!==null){if(n[M]!==void 0)return n[M];Ne("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+M+"'")}let he;te&&(he=e.get("EXT_texture_norm16"),he||Ne("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let J=x;if(x===n.RED&&(V===n.FLOAT&&(J=n.R32F),V===n.HALF_FLOAT&&(J=n.R16F),V===n.UNSIGNED_BYTE&&(J=n.R8),V===n.UNSIGNED_SHORT&&he&&(J=he.R16_EXT),V===n.SHORT&&he&&(J=he.R16_SNORM_EXT)),x===n.RED_INTEGER&&(V===n.UNSIGNED_BYTE&&(J=n.R8UI),V===n.UNSIGNED_SHORT&&(J=n.R16UI),V===n.UNSIGNED_INT&&(J=n.R32UI),V===n.BYTE&&(J=n.R8I),V===n.SHORT&&(J=n.R16I),V===n.INT&&(J=n.R32I)),x===n.RG&&(V===n.FLOAT&&(J=n.RG32F),V===n.HALF_FLOAT&&(J=n.RG16F),V===n.UNSIGNED_BYTE&&(J=n.RG8),V===n.UNSIGNED_SHORT&&he&&(J=he.RG16_EXT),V===n.SHORT&&he&&(J=he.RG16_SNORM_EXT)),x===n.RG_INTEGER&&(V===n.UNSIGNED_BYTE&&(J=n.RG8UI),V===n.UNSIGNED_SHORT&&(J=n.RG16UI),V===n.UNSIGNED_INT&&(J=n.RG32UI),V===n.BYTE&&(J=n.RG8I),V===n.SHORT&&(J=n.RG16I),V===n.INT&&(J=n.RG32I)),x===n.RGB_INTEGER&&(V===n.UNSIGNED_BYTE&&(J=n.RGB8UI),V===n.UNSIGNED_SHORT&&(J=n.RGB16UI),V===n.UNSIGNED_INT&&(J=n.RGB32UI),V===n.BYTE&&(J=n.RGB8I),V===n.SHORT&&(J=n.RGB16I),V===n.INT&&(J=n.RGB32I)),x===n.RGBA_INTEGER&&(V===n.UNSIGNED_BYTE&&(J=n.RGBA8UI),V===n.UNSIGNED_SHORT&&(J=n.RGBA16UI),V===n.UNSIGNED_INT&&(J=n.RGBA32UI),V===n.BYTE&&(J=n.RGBA8I),V===n.SHORT&&(J=n.RGBA16I),V===n.INT&&(J=n.RGBA32I)),x===n.RGB&&(V===n.UNSIGNED_SHORT&&he&&(J=he.RGB16_EXT),V===n.SHORT&&he&&(J=he.RGB16_SNORM_EXT),V===n.UNSIGNED_INT_5_9_9_9_REV&&(J=n.RGB9_E5),V===n.UNSIGNED_INT_10F_11F_11F_REV&&(J=n.R11F_G11F_B10F)),x===n.RGBA){let Q=ae?vo:je.getTransfer(j);V===n.FLOAT&&(J=n.RGBA32F),V===n.HALF_FLOAT&&(J=n.RGBA16F),V===n.UNSIGNED_BYTE&&(J=Q===ct?n.SRGB8_ALPHA8:n.RGBA8),V===n.UNSIGNED_SHORT&&he&&(J=he.RGBA16_EXT),V===n.SHORT&&he&&(J=he.RGBA16_SNORM_EXT),V===n.UNSIGNED_SHORT_4_4_4_4&&(J=n.RGBA4),V===n.UNSIGNED_SHORT_5_5_5_1&&(J=n.RGB5_A1)}return(J===n.R16F||J===n.R32F||J===n.RG16F||J===n.RG32F||J===n.RGBA16F||J===n.RGBA32F)&&e.get("EXT_color_buffer_float"),J}function y(M,x){let V;return M?x===null||x===ci||x===Cs?V=n.DEPTH24_STENCIL8:x===Zn?V=n.DEPTH32F_STENCIL8:x===Tr&&(V=n.DEPTH24_STENCIL8,Ne("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):x===null||x===ci||x===Cs?V=n.DEPTH_COMPONENT24:x===Zn?V=n.DEPTH_COMPONENT32F:x===Tr&&(V=n.DEPTH_COMPONENT16),V}function E(M,x){return A(M)===!0||M.isFramebufferTexture&&M.minFilter!==Jt&&M.minFilter!==gn?Math.log2(Math.max(x.width,x.height))+1:M.mipmaps.length>0?M.mipmaps.length:M.isCompressedTexture&&Array.isArray(M.image)?x.mipmaps.length:1}function L(M){let x=new WeakRef(M);i.get(M).__ref=x,f.add(x),b.register(M,x,x)}function C(M){let x=i.get(M).__ref;x!==void 0&&(f.delete(x),b.unregister(x))}function P(M){W(M.target)}function D(M){I(M.target)}function W(M){M.removeEventListener("dispose",P),C(M),Y(M),M.isVideoTexture&&u.delete(M),M.isHTMLTexture&&h.delete(M)}function I(M){M.removeEventListener("dispose",D),C(M),ne(M)}function X(){for(let M of f){let x=M.deref();x!==void 0&&(x.isRenderTarget===!0?I(x):W(x))}f.clear(),h.clear()}function Y(M){let x=i.get(M);if(x.__webglInit===void 0)return;let V=M.source,te=d.get(V);if(te){let j=te[x.__cacheKey];j.usedTimes--,j.usedTimes===0&&z(M),Object.keys(te).length===0&&d.delete(V)}i.remove(M)}function z(M){let x=i.get(M);n.deleteTexture(x.__webglTexture);let V=M.source,te=d.get(V);delete te[x.__cacheKey],o.memory.textures--}function ne(M){let x=i.get(M);x.__depthDisposeCallback&&x.__depthDisposeCallback();let V=M.depthTexture;if(V&&V.renderTarget===M&&W(V),M.isWebGLCubeRenderTarget)for(let j=0;j<6;j++){if(Array.isArray(x.__webglFramebuffer[j]))for(let ae=0;ae<x.__webglFramebuffer[j].length;ae++)n.deleteFramebuffer(x.__webglFramebuffer[j][ae]);else n.deleteFramebuffer(x.__webglFramebuffer[j]);x.__webglDepthbuffer&&n.deleteRenderbuffer(x.__webglDepthbuffer[j])}else{if(Array.isArray(x.__webglFramebuffer))for(let j=0;j<x.__webglFramebuffer.length;j++)n.deleteFramebuffer(x.__webglFramebuffer[j]);else n.deleteFramebuffer(x.__webglFramebuffer);if(x.__webglDepthbuffer&&n.deleteRenderbuffer(x.__webglDepthbuffer),x.__webglMultisampledFramebuffer&&n.deleteFramebuffer(x.__webglMultisampledFramebuffer),x.__webglColorRenderbuffer)for(let j=0;j<x.__webglColorRenderbuffer.length;j++)x.__webglColorRenderbuffer[j]&&n.deleteRenderbuffer(x.__webglColorRenderbuffer[j]);x.__webglDepthRenderbuffer&&n.deleteRenderbuffer(x.__webglDepthRenderbuffer)}let te=M.textures;for(let j=0,ae=te.length;j<ae;j++){let he=i.get(te[j]);he.__webglTexture&&(n.deleteTexture(he.__webglTexture),o.memory.textures--),i.remove(te[j])}i.remove(M)}let H=0;function $(){H=0}function ee(){return H}function Me(M){H=M}function Oe(){let M=H;return M>=s.maxTextures&&Ne("WebGLTextures: Trying to use "+(M+1)+" texture units while this GPU supports only "+s.maxTextures),H+=1,M}function K(M){let x=[];return x.push(M.wrapS),x.push(M.wrapT),x.push(M.wrapR||0),x.push(M.magFilter),x.push(M.minFilter),x.push(M.anisotropy),x.push(M.internalFormat),x.push(M.format),x.push(M.type),x.push(M.generateMipmaps),x.push(M.mipmapsAutoUpdate),x.push(M.premultiplyAlpha),x.push(M.flipY),x.push(M.unpackAlignment),x.push(M.colorSpace),x.join()}function ye(M,x){let V=i.get(M);if(M.isVideoTexture&&Gt(M),M.isRenderTargetTexture===!1&&M.isExternalTexture!==!0&&M.version>0&&V.__version!==M.version){let te=M.image;if(te===null)Ne("WebGLRenderer: Texture marked for update but no image data found.");else if(te.complete===!1)Ne("WebGLRenderer: Texture marked for update but image is incomplete");else{Dt(V,M,x);return}}else M.isExternalTexture&&(V.__webglTexture=M.sourceTexture?M.sourceTexture:null);t.bindTexture(n.TEXTURE_2D,V.__webglTexture,n.TEXTURE0+x)}function Se(M,x){let V=i.get(M);if(M.isRenderTargetTexture===!1&&M.version>0&&V.__version!==M.version){Dt(V,M,x);return}else M.isExternalTexture&&(V.__webglTexture=M.sourceTexture?M.sourceTexture:null);t.bindTexture(n.TEXTURE_2D_ARRAY,V.__webglTexture,n.TEXTURE0+x)}function Le(M,x){let V=i.get(M);if(M.isRenderTargetTexture===!1&&M.version>0&&V.__version!==M.version){Dt(V,M,x);return}t.bindTexture(n.TEXTURE_3D,V.__webglTexture,n.TEXTURE0+x)}function be(M,x){let V=i.get(M);if(M.version>0&&V.__version!==M.version){Sn(V,M,x);return}t.bindTexture(n.TEXTURE_CUBE_MAP,V.__webglTexture,n.TEXTURE0+x)}let ze={[fr]:n.REPEAT,[fi]:n.CLAMP_TO_EDGE,[Pl]:n.MIRRORED_REPEAT},Nt={[Jt]:n.NEAREST,[Hy]:n.NEAREST_MIPMAP_NEAREST,[Yo]:n.NEAREST_MIPMAP_LINEAR,[gn]:n.LINEAR,[lc]:n.LINEAR_MIPMAP_NEAREST,[Gi]:n.LINEAR_MIPMAP_LINEAR},Ue={[Ky]:n.NEVER,[Th]:n.ALWAYS,[qy]:n.LESS,[Rh]:n.LEQUAL,[jy]:n.EQUAL,[wh]:n.GEQUAL,[$y]:n.GREATER,[eb]:n.NOTEQUAL};function dt(M,x){if(x.type===Zn&&e.has("OES_texture_float_linear")===!1&&(x.magFilter===gn||x.magFilter===lc||x.magFilter===Yo||x.magFilter===Gi||x.minFilter===gn||x.minFilter===lc||x.minFilter===Yo||x.minFilter===Gi)&&Ne("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),n.texParameteri(M,n.TEXTURE_WRAP_S,ze[x.wrapS]),n.texParameteri(M,n.TEXTURE_WRAP_T,ze[x.wrapT]),(M===n.TEXTURE_3D||M===n.TEXTURE_2D_ARRAY)&&n.texParameteri(M,n.TEXTURE_WRAP_R,ze[x.wrapR]),n.texParameteri(M,n.TEXTURE_MAG_FILTER,Nt[x.magFilter]),n.texParameteri(M,n.TEXTURE_MIN_FILTER,Nt[x.minFilter]),x.compareFunction&&(n.texParameteri(M,n.TEXTURE_COMPARE_MODE,n.COMPARE_REF_TO_TEXTURE),n.texParameteri(M,n.TEXTURE_COMPARE_FUNC,Ue[x.compareFunction])),e.has("EXT_texture_filter_anisotropic")===!0){if(x.magFilter===Jt||x.minFilter!==Yo&&x.minFilter!==Gi||x.type===Zn&&e.has("OES_texture_float_linear")===!1)return;if(x.anisotropy>1||i.get(x).__currentAnisotropy){let V=e.get("EXT_texture_filter_anisotropic");n.texParameterf(M,V.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(x.anisotropy,s.getMaxAnisotropy())),i.get(x).__currentAnisotropy=x.anisotropy}}}function gt(M,x){let V=!1;M.__webglInit===void 0&&(M.__webglInit=!0,x.addEventListener("dispose",P),L(x));let te=x.source,j=d.get(te);j===void 0&&(j={},d.set(te,j));let ae=K(x);if(ae!==M.__cacheKey){j[ae]===void 0&&(j[ae]={texture:n.createTexture(),usedTimes:0},o.memory.textures++,V=!0),j[ae].usedTimes++;let he=j[M.__cacheKey];he!==void 0&&(j[M.__cacheKey].usedTimes--,he.usedTimes===0&&z(x)),M.__cacheKey=ae,M.__webglTexture=j[ae].texture}return V}function Qe(M,x,V){return Math.floor(Math.floor(M/V)/x)}function Kt(M,x,V,te){let ae=M.updateRanges;if(ae.length===0)t.texSubImage2D(n.TEXTURE_2D,0,0,0,x.width,x.height,V,te,x.data);else{ae.sort((T,q)=>T.start-q.start);let he=0;for(let T=1;T<ae.length;T++){let q=ae[he],Z=ae[T],ue=q.start+q.count,oe=Qe(Z.start,x.width,4),le=Qe(q.start,x.width,4);Z.start<=ue+1&&oe===le&&Qe(Z.start+Z.count-1,x.width,4)===oe?q.count=Math.max(q.count,Z.start+Z.count-q.start):(++he,ae[he]=Z)}ae.length=he+1;let J=t.getParameter(n.UNPACK_ROW_LENGTH),Q=t.getParameter(n.UNPACK_SKIP_PIXELS),ce=t.getParameter(n.UNPACK_SKIP_ROWS);t.pixelStorei(n.UNPACK_ROW_LENGTH,x.width);for(let T=0,q=ae.length;T<q;T++){let Z=ae[T],ue=Math.floor(Z.start/4),oe=Math.ceil(Z.count/4),le=ue%x.width,we=Math.floor(ue/x.width),Ze=oe,ie=1;t.pixelStorei(n.UNPACK_SKIP_PIXELS,le),t.pixelStorei(n.UNPACK_SKIP_ROWS,we),t.texSubImage2D(n.TEXTURE_2D,0,le,we,Ze,ie,V,te,x.data)}M.clearUpdateRanges(),t.pixelStorei(n.UNPACK_ROW_LENGTH,J),t.pixelStorei(n.UNPACK_SKIP_PIXELS,Q),t.pixelStorei(n.UNPACK_SKIP_ROWS,ce)}}function Dt(M,x,V){let te=n.TEXTURE_2D;(x.isDataArrayTexture||x.isCompressedArrayTexture)&&(te=n.TEXTURE_2D_ARRAY),x.isData3DTexture&&(te=n.TEXTURE_3D);let j=gt(M,x),ae=x.source;t.bindTexture(te,M.__webglTexture,n.TEXTURE0+V);let he=i.get(ae);if(ae.version!==he.__version||j===!0){if(t.activeTexture(n.TEXTURE0+V),(typeof ImageBitmap<"u"&&x.image instanceof ImageBitmap)===!1){let ie=je.getPrimaries(je.workingColorSpace),Ce=x.colorSpace===Oi?null:je.getPrimaries(x.colorSpace),Xe=x.colorSpace===Oi||ie===Ce?n.NONE:n.BROWSER_DEFAULT_WEBGL;t.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,x.flipY),t.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,x.premultiplyAlpha),t.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,Xe)}t.pixelStorei(n.UNPACK_ALIGNMENT,x.unpackAlignment);let Q=S(x.image,!1,s.maxTextureSize);Q=Fe(x,Q);let ce=r.convert(x.format,x.colorSpace),T=r.convert(x.type),q=R(x.internalFormat,ce,T,x.normalized,x.colorSpace,x.isVideoTexture);dt(te,x);let Z,ue=x.mipmaps,oe=x.isVideoTexture!==!0,le=he.__version===void 0||j===!0,we=ae.dataReady,Ze=E(x,Q);if(x.isDepthTexture)q=y(x.format===Vi,x.type),le&&(oe?t.texStorage2D(n.TEXTURE_2D,1,q,Q.width,Q.height):t.texImage2D(n.TEXTURE_2D,0,q,Q.width,Q.height,0,ce,T,null));else if(x.isDataTexture)if(ue.length>0){oe&&le&&t.texStorage2D(n.TEXTURE_2D,Ze,q,ue[0].width,ue[0].height);for(let ie=0,Ce=ue.length;ie<Ce;ie++)Z=ue[ie],oe?we&&t.texSubImage2D(n.TEXTURE_2D,ie,0,0,Z.width,Z.height,ce,T,Z.data):t.texImage2D(n.TEXTURE_2D,ie,q,Z.width,Z.height,0,ce,T,Z.data);x.generateMipmaps=!1}else oe?(le&&t.texStorage2D(n.TEXTURE_2D,Ze,q,Q.width,Q.height),we&&Kt(x,Q,ce,T)):t.texImage2D(n.TEXTURE_2D,0,q,Q.width,Q.height,0,ce,T,Q.data);else if(x.isCompressedTexture)if(x.isCompressedArrayTexture){oe&&le&&t.texStorage3D(n.TEXTURE_2D_ARRAY,Ze,q,ue[0].width,ue[0].height,Q.depth);for(let ie=0,Ce=ue.length;ie<Ce;ie++)if(Z=ue[ie],x.format!==Hn)if(ce!==null)if(oe){if(we)if(x.layerUpdates.size>0){let Xe=Dh(Z.width,Z.height,x.format,x.type);for(let me of x.layerUpdates){let ht=Z.data.subarray(me*Xe/Z.data.BYTES_PER_ELEMENT,(me+1)*Xe/Z.data.BYTES_PER_ELEMENT);t.compressedTexSubImage3D(n.TEXTURE_2D_ARRAY,ie,0,0,me,Z.width,Z.height,1,ce,ht)}}else t.compressedTexSubImage3D(n.TEXTURE_2D_ARRAY,ie,0,0,0,Z.width,Z.height,Q.depth,ce,Z.data)}else t.compressedTexImage3D(n.TEXTURE_2D_ARRAY,ie,q,Z.width,Z.height,Q.depth,0,Z.data,0,0);else Ne("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else oe?we&&t.texSubImage3D(n.TEXTURE_2D_ARRAY,ie,0,0,0,Z.width,Z.height,Q.depth,ce,T,Z.data):t.texImage3D(n.TEXTURE_2D_ARRAY,ie,q,Z.width,Z.height,Q.depth,0,ce,T,Z.data);x.layerUpdates.size>0&&x.clearLayerUpdates()}else{oe&&le&&t.texStorage2D(n.TEXTURE_2D,Ze,q,ue[0].width,ue[0].height);for(let ie=0,Ce=ue.length;ie<Ce;ie++)Z=ue[ie],x.format!==Hn?ce!==null?oe?we&&t.compressedTexSubImage2D(n.TEXTURE_2D,ie,0,0,Z.width,Z.height,ce,Z.data):t.compressedTexImage2D(n.TEXTURE_2D,ie,q,Z.width,Z.height,0,Z.data):Ne("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):oe?we&&t.texSubImage2D(n.TEXTURE_2D,ie,0,0,Z.width,Z.height,ce,T,Z.data):t.texImage2D(n.TEXTURE_2D,ie,q,Z.width,Z.height,0,ce,T,Z.data)}else if(x.isDataArrayTexture)if(oe){if(le&&t.texStorage3D(n.TEXTURE_2D_ARRAY,Ze,q,Q.width,Q.height,Q.depth),we)if(x.layerUpdates.size>0){let ie=Dh(Q.width,Q.height,x.format,x.type);for(let Ce of x.layerUpdates){let Xe=Q.data.subarray(Ce*ie/Q.data.BYTES_PER_ELEMENT,(Ce+1)*ie/Q.data.BYTES_PER_ELEMENT);t.texSubImage3D(n.TEXTURE_2D_ARRAY,0,0,0,Ce,Q.width,Q.height,1,ce,T,Xe)}x.clearLayerUpdates()}else t.texSubImage3D(n.TEXTURE_2D_ARRAY,0,0,0,0,Q.width,Q.height,Q.depth,ce,T,Q.data)}else t.texImage3D(n.TEXTURE_2D_ARRAY,0,q,Q.width,Q.height,Q.depth,0,ce,T,Q.data);else if(x.isData3DTexture)oe?(le&&t.texStorage3D(n.TEXTURE_3D,Ze,q,Q.width,Q.height,Q.depth),we&&t.texSubImage3D(n.TEXTURE_3D,0,0,0,0,Q.width,Q.height,Q.depth,ce,T,Q.data)):t.texImage3D(n.TEXTURE_3D,0,q,Q.width,Q.height,Q.depth,0,ce,T,Q.data);else if(x.isFramebufferTexture){if(le)if(oe)t.texStorage2D(n.TEXTURE_2D,Ze,q,Q.width,Q.height);else{let ie=Q.width,Ce=Q.height;for(let Xe=0;Xe<Ze;Xe++)t.texImage2D(n.TEXTURE_2D,Xe,q,ie,Ce,0,ce,T,null),ie>>=1,Ce>>=1}}else if(x.isHTMLTexture){if("texElementImage2D"in n){let ie=n.canvas;if(ie.hasAttribute("layoutsubtree")||ie.setAttribute("layoutsubtree","true"),Q.parentNode!==ie){ie.appendChild(Q),h.add(x),ie.onpaint=Ce=>{let Xe=Ce.changedElements;for(let me of h)Xe.includes(me.image)&&(me.needsUpdate=!0)},ie.requestPaint();return}if(n.texElementImage2D.length===3)n.texElementImage2D(n.TEXTURE_2D,n.RGBA8,Q);else{let Xe=n.RGBA,me=n.RGBA,ht=n.UNSIGNED_BYTE;n.texElementImage2D(n.TEXTURE_2D,0,Xe,me,ht,Q)}n.texParameteri(n.TEXTURE_2D,n.TEXTURE_MIN_FILTER,n.LINEAR),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_WRAP_S,n.CLAMP_TO_EDGE),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_WRAP_T,n.CLAMP_TO_EDGE)}}else if(ue.length>0){if(oe&&le){let ie=Ge(ue[0]);t.texStorage2D(n.TEXTURE_2D,Ze,q,ie.width,ie.height)}for(let ie=0,Ce=ue.length;ie<Ce;ie++)Z=ue[ie],oe?we&&t.texSubImage2D(n.TEXTURE_2D,ie,0,0,ce,T,Z):t.texImage2D(n.TEXTURE_2D,ie,q,ce,T,Z);x.generateMipmaps=!1}else if(oe){if(le){let ie=Ge(Q);t.texStorage2D(n.TEXTURE_2D,Ze,q,ie.width,ie.height)}we&&t.texSubImage2D(n.TEXTURE_2D,0,0,0,ce,T,Q)}else t.texImage2D(n.TEXTURE_2D,0,q,ce,T,Q);A(x)&&x.mipmapsAutoUpdate===!0&&_(te),he.__version=ae.version,x.onUpdate&&x.onUpdate(x)}M.__version=x.version}function Sn(M,x,V){if(x.image.length!==6)return;let te=gt(M,x),j=x.source;t.bindTexture(n.TEXTURE_CUBE_MAP,M.__webglTexture,n.TEXTURE0+V);let ae=i.get(j);if(j.version!==ae.__version||te===!0){t.activeTexture(n.TEXTURE0+V);let he=je.getPrimaries(je.workingColorSpace),J=x.colorSpace===Oi?null:je.getPrimaries(x.colorSpace),Q=x.colorSpace===Oi||he===J?n.NONE:n.BROWSER_DEFAULT_WEBGL;t.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,x.flipY),t.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,x.premultiplyAlpha),t.pixelStorei(n.UNPACK_ALIGNMENT,x.unpackAlignment),t.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,Q);let ce=x.isCompressedTexture||x.image[0].isCompressedTexture,T=x.image[0]&&x.image[0].isDataTexture,q=[];for(let me=0;me<6;me++)!ce&&!T?q[me]=S(x.image[me],!0,s.maxCubemapSize):q[me]=T?x.image[me].image:x.image[me],q[me]=Fe(x,q[me]);let Z=q[0],ue=r.convert(x.format,x.colorSpace),oe=r.convert(x.type),le=R(x.internalFormat,ue,oe,x.normalized,x.colorSpace),we=x.isVideoTexture!==!0,Ze=ae.__version===void 0||te===!0,ie=j.dataReady,Ce=E(x,Z);dt(n.TEXTURE_CUBE_MAP,x);let Xe;if(x.isDepthTexture){if(le=y(x.format===Vi,x.type),Ze)if(we)t.texStorage2D(n.TEXTURE_CUBE_MAP,1,le,Z.width,Z.height);else for(let me=0;me<6;me++)t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,0,le,Z.width,Z.height,0,ue,oe,null)}else if(ce){we&&Ze&&t.texStorage2D(n.TEXTURE_CUBE_MAP,Ce,le,Z.width,Z.height);for(let me=0;me<6;me++){Xe=q[me].mipmaps;for(let ht=0;ht<Xe.length;ht++){let Zt=Xe[ht];x.format!==Hn?ue!==null?we?ie&&t.compressedTexSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,ht,0,0,Zt.width,Zt.height,ue,Zt.data):t.compressedTexImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,ht,le,Zt.width,Zt.height,0,Zt.data):Ne("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):we?ie&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,ht,0,0,Zt.width,Zt.height,ue,oe,Zt.data):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,ht,le,Zt.width,Zt.height,0,ue,oe,Zt.data)}}}else{if(Xe=x.mipmaps,we&&Ze){Xe.length>0&&Ce++;let me=Ge(q[0]);t.texStorage2D(n.TEXTURE_CUBE_MAP,Ce,le,me.width,me.height)}for(let me=0;me<6;me++)if(T){we?ie&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,0,0,0,q[me].width,q[me].height,ue,oe,q[me].data):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,0,le,q[me].width,q[me].height,0,ue,oe,q[me].data);for(let ht=0;ht<Xe.length;ht++){let zi=Xe[ht].image[me].image;we?ie&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,ht+1,0,0,zi.width,zi.height,ue,oe,zi.data):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,ht+1,le,zi.width,zi.height,0,ue,oe,zi.data)}}else{we?ie&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,0,0,0,ue,oe,q[me]):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,0,le,ue,oe,q[me]);for(let ht=0;ht<Xe.length;ht++){let Zt=Xe[ht];we?ie&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,ht+1,0,0,ue,oe,Zt.image[me]):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+me,ht+1,le,ue,oe,Zt.image[me])}}}A(x)&&x.mipmapsAutoUpdate===!0&&_(n.TEXTURE_CUBE_MAP),ae.__version=j.version,x.onUpdate&&x.onUpdate(x)}M.__version=x.version}function Rt(M,x,V,te,j,ae){let he=r.convert(V.format,V.colorSpace),J=r.convert(V.type),Q=R(V.internalFormat,he,J,V.normalized,V.colorSpace),ce=i.get(x),T=i.get(V);if(T.__renderTarget=x,!ce.__hasExternalTextures){let q=Math.max(1,x.width>>ae),Z=Math.max(1,x.height>>ae);j===n.TEXTURE_3D||j===n.TEXTURE_2D_ARRAY?t.texImage3D(j,ae,Q,q,Z,x.depth,0,he,J,null):t.texImage2D(j,ae,Q,q,Z,0,he,J,null)}t.bindFramebuffer(n.FRAMEBUFFER,M),fe(x)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,te,j,T.__webglTexture,0,Et(x)):(j===n.TEXTURE_2D||j>=n.TEXTURE_CUBE_MAP_POSITIVE_X&&j<=n.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&n.framebufferTexture2D(n.FRAMEBUFFER,te,j,T.__webglTexture,ae),t.bindFramebuffer(n.FRAMEBUFFER,null)}function di(M,x,V){if(n.bindRenderbuffer(n.RENDERBUFFER,M),x.depthBuffer){let te=x.depthTexture,j=te&&te.isDepthTexture?te.type:null,ae=y(x.stencilBuffer,j),he=x.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;fe(x)?a.renderbufferStorageMultisampleEXT(n.RENDERBUFFER,Et(x),ae,x.width,x.height):V?n.renderbufferStorageMultisample(n.RENDERBUFFER,Et(x),ae,x.width,x.height):n.renderbufferStorage(n.RENDERBUFFER,ae,x.width,x.height),n.framebufferRenderbuffer(n.FRAMEBUFFER,he,n.RENDERBUFFER,M)}else{let te=x.textures;for(let j=0;j<te.length;j++){let ae=te[j],he=r.convert(ae.format,ae.colorSpace),J=r.convert(ae.type),Q=R(ae.internalFormat,he,J,ae.normalized,ae.colorSpace);fe(x)?a.renderbufferStorageMultisampleEXT(n.RENDERBUFFER,Et(x),Q,x.width,x.height):V?n.renderbufferStorageMultisample(n.RENDERBUFFER,Et(x),Q,x.width,x.height):n.renderbufferStorage(n.RENDERBUFFER,Q,x.width,x.height)}}n.bindRenderbuffer(n.RENDERBUFFER,null)}function Xt(M,x,V){let te=x.isWebGLCubeRenderTarget===!0;if(t.bindFramebuffer(n.FRAMEBUFFER,M),!(x.depthTexture&&x.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let j=i.get(x.depthTexture);j.__renderTarget=x;let ae=te?x.depthTexture.image[0]:x.depthTexture.image;(!j.__webglTexture||ae.width!==x.width||ae.height!==x.height)&&(ae.width=x.width,ae.height=x.height,x.depthTexture.needsUpdate=!0),te?be(x.depthTexture,0):ye(x.depthTexture,0);let he=j.__webglTexture,J=Et(x),Q=te?n.TEXTURE_CUBE_MAP_POSITIVE_X+V:n.TEXTURE_2D,ce=x.depthTexture.format===Vi?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;if(x.depthTexture.format===Fi)fe(x)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,ce,Q,he,0,J):n.framebufferTexture2D(n.FRAMEBUFFER,ce,Q,he,0);else if(x.depthTexture.format===Vi)fe(x)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,ce,Q,he,0,J):n.framebufferTexture2D(n.FRAMEBUFFER,ce,Q,he,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function Un(M){let x=i.get(M),V=M.isWebGLCubeRenderTarget===!0;if(x.__boundDepthTexture!==M.depthTexture){let te=M.depthTexture;if(x.__depthDisposeCallback&&x.__depthDisposeCallback(),te){let j=()=>{delete x.__boundDepthTexture,delete x.__depthDisposeCallback,te.removeEventListener("dispose",j)};te.addEventListener("dispose",j),x.__depthDisposeCallback=j}x.__boundDepthTexture=te}if(M.depthTexture&&!x.__autoAllocateDepthBuffer)if(V)for(let te=0;te<6;te++)Xt(x.__webglFramebuffer[te],M,te);else M.texture.mipmaps.length>0?Xt(x.__webglFramebuffer[0],M,0):Xt(x.__webglFramebuffer,M,0);else if(V){x.__webglDepthbuffer=[];for(let te=0;te<6;te++)if(t.bindFramebuffer(n.FRAMEBUFFER,x.__webglFramebuffer[te]),x.__webglDepthbuffer[te]===void 0)x.__webglDepthbuffer[te]=n.createRenderbuffer(),di(x.__webglDepthbuffer[te],M,!1);else{let j=M.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,ae=x.__webglDepthbuffer[te];n.bindRenderbuffer(n.RENDERBUFFER,ae),n.framebufferRenderbuffer(n.FRAMEBUFFER,j,n.RENDERBUFFER,ae)}}else if(M.texture.mipmaps.length>0?t.bindFramebuffer(n.FRAMEBUFFER,x.__webglFramebuffer[0]):t.bindFramebuffer(n.FRAMEBUFFER,x.__webglFramebuffer),x.__webglDepthbuffer===void 0)x.__webglDepthbuffer=n.createRenderbuffer(),di(x.__webglDepthbuffer,M,!1);else{let j=M.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,ae=x.__webglDepthbuffer;n.bindRenderbuffer(n.RENDERBUFFER,ae),n.framebufferRenderbuffer(n.FRAMEBUFFER,j,n.RENDERBUFFER,ae)}t.bindFramebuffer(n.FRAMEBUFFER,null)}function Pn(M,x,V){let te=i.get(M);x!==void 0&&Rt(te.__webglFramebuffer,M,M.texture,n.COLOR_ATTACHMENT0,n.TEXTURE_2D,0),V!==void 0&&Un(M)}function Dn(M){let x=M.texture,V=i.get(M),te=i.get(x);M.addEventListener("dispose",D),L(M);let j=M.textures,ae=M.isWebGLCubeRenderTarget===!0,he=j.length>1;if(he||(te.__webglTexture===void 0&&(te.__webglTexture=n.createTexture()),te.__version=x.version,o.memory.textures++),ae){V.__webglFramebuffer=[];for(let J=0;J<6;J++)if(x.mipmaps.length>0){V.__webglFramebuffer[J]=[];for(let Q=0;Q<x.mipmaps.length;Q++)V.__webglFramebuffer[J][Q]=n.createFramebuffer()}else V.__webglFramebuffer[J]=n.createFramebuffer()}else{if(x.mipmaps.length>0){V.__webglFramebuffer=[];for(let J=0;J<x.mipmaps.length;J++)V.__webglFramebuffer[J]=n.createFramebuffer()}else V.__webglFramebuffer=n.createFramebuffer();if(he)for(let J=0,Q=j.length;J<Q;J++){let ce=i.get(j[J]);ce.__webglTexture===void 0&&(ce.__webglTexture=n.createTexture(),o.memory.textures++)}if(M.samples>0&&fe(M)===!1){V.__webglMultisampledFramebuffer=n.createFramebuffer(),V.__webglColorRenderbuffer=[],t.bindFramebuffer(n.FRAMEBUFFER,V.__webglMultisampledFramebuffer);for(let J=0;J<j.length;J++){let Q=j[J];V.__webglColorRenderbuffer[J]=n.createRenderbuffer(),n.bindRenderbuffer(n.RENDERBUFFER,V.__webglColorRenderbuffer[J]);let ce=r.convert(Q.format,Q.colorSpace),T=r.convert(Q.type),q=R(Q.internalFormat,ce,T,Q.normalized,Q.colorSpace,M.isXRRenderTarget===!0),Z=Et(M);n.renderbufferStorageMultisample(n.RENDERBUFFER,Z,q,M.width,M.height),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+J,n.RENDERBUFFER,V.__webglColorRenderbuffer[J])}n.bindRenderbuffer(n.RENDERBUFFER,null),M.depthBuffer&&(V.__webglDepthRenderbuffer=n.createRenderbuffer(),di(V.__webglDepthRenderbuffer,M,!0)),t.bindFramebuffer(n.FRAMEBUFFER,null)}}if(ae){t.bindTexture(n.TEXTURE_CUBE_MAP,te.__webglTexture),dt(n.TEXTURE_CUBE_MAP,x);for(let J=0;J<6;J++)if(x.mipmaps.length>0)for(let Q=0;Q<x.mipmaps.length;Q++)Rt(V.__webglFramebuffer[J][Q],M,x,n.COLOR_ATTACHMENT0,n.TEXTURE_CUBE_MAP_POSITIVE_X+J,Q);else Rt(V.__webglFramebuffer[J],M,x,n.COLOR_ATTACHMENT0,n.TEXTURE_CUBE_MAP_POSITIVE_X+J,0);A(x)?_(n.TEXTURE_CUBE_MAP):x.mipmaps.length>0&&n.texParameteri(n.TEXTURE_CUBE_MAP,n.TEXTURE_MAX_LEVEL,x.mipmaps.length-1),t.unbindTexture()}else if(he){for(let J=0,Q=j.length;J<Q;J++){let ce=j[J],T=i.get(ce),q=n.TEXTURE_2D;(M.isWebGL3DRenderTarget||M.isWebGLArrayRenderTarget)&&(q=M.isWebGL3DRenderTarget?n.TEXTURE_3D:n.TEXTURE_2D_ARRAY),t.bindTexture(q,T.__webglTexture),dt(q,ce),Rt(V.__webglFramebuffer,M,ce,n.COLOR_ATTACHMENT0+J,q,0),A(ce)&&_(q)}t.unbindTexture()}else{let J=n.TEXTURE_2D;if((M.isWebGL3DRenderTarget||M.isWebGLArrayRenderTarget)&&(J=M.isWebGL3DRenderTarget?n.TEXTURE_3D:n.TEXTURE_2D_ARRAY),t.bindTexture(J,te.__webglTexture),dt(J,x),x.mipmaps.length>0)for(let Q=0;Q<x.mipmaps.length;Q++)Rt(V.__webglFramebuffer[Q],M,x,n.COLOR_ATTACHMENT0,J,Q);else Rt(V.__webglFramebuffer,M,x,n.COLOR_ATTACHMENT0,J,0);A(x)?_(J):x.mipmaps.length>0&&n.texParameteri(J,n.TEXTURE_MAX_LEVEL,x.mipmaps.length-1),t.unbindTexture()}M.depthBuffer&&Un(M)}function U(M){let x=M.textures;for(let V=0,te=x.length;V<te;V++){let j=x[V];if(A(j)&&j.mipmapsAutoUpdate===!0){let ae=w(M),he=i.get(j).__webglTexture;t.bindTexture(ae,he),_(ae),t.unbindTexture()}}}let Gn=[];function _t(M){if(M.samples>0){if(fe(M)===!1){let x=M.textures,V=M.width,te=M.height,j=n.COLOR_BUFFER_BIT,ae=M.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,he=i.get(M),J=x.length>1;if(J)for(let ce=0;ce<x.length;ce++)t.bindFramebuffer(n.FRAMEBUFFER,he.__webglMultisampledFramebuffer),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+ce,n.RENDERBUFFER,null),t.bindFramebuffer(n.FRAMEBUFFER,he.__webglFramebuffer),n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0+ce,n.TEXTURE_2D,null,0);t.bindFramebuffer(n.READ_FRAMEBUFFER,he.__webglMultisampledFramebuffer),M.texture.mipmaps.length>0?t.bindFramebuffer(n.DRAW_FRAMEBUFFER,he.__webglFramebuffer[0]):t.bindFramebuffer(n.DRAW_FRAMEBUFFER,he.__webglFramebuffer);for(let ce=0;ce<x.length;ce++){if(M.resolveDepthBuffer&&(M.depthBuffer&&(j|=n.DEPTH_BUFFER_BIT),M.stencilBuffer&&M.resolveStencilBuffer&&(j|=n.STENCIL_BUFFER_BIT)),J){n.framebufferRenderbuffer(n.READ_FRAMEBUFFER,n.COLOR_ATTACHMENT0,n.RENDERBUFFER,he.__webglColorRenderbuffer[ce]);let T=i.get(x[ce]).__webglTexture;n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0,n.TEXTURE_2D,T,0)}n.blitFramebuffer(0,0,V,te,0,0,V,te,j,n.NEAREST),l===!0&&(Gn.length=0,Gn.push(n.COLOR_ATTACHMENT0+ce),M.depthBuffer&&M.storeMultisampledDepthBuffer===!1&&Gn.push(ae),n.invalidateFramebuffer(n.READ_FRAMEBUFFER,Gn))}if(t.bindFramebuffer(n.READ_FRAMEBUFFER,null),t.bindFramebuffer(n.DRAW_FRAMEBUFFER,null),J)for(let ce=0;ce<x.length;ce++){t.bindFramebuffer(n.FRAMEBUFFER,he.__webglMultisampledFramebuffer),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+ce,n.RENDERBUFFER,he.__webglColorRenderbuffer[ce]);let T=i.get(x[ce]).__webglTexture;t.bindFramebuffer(n.FRAMEBUFFER,he.__webglFramebuffer),n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0+ce,n.TEXTURE_2D,T,0)}t.bindFramebuffer(n.DRAW_FRAMEBUFFER,he.__webglMultisampledFramebuffer)}else if(M.depthBuffer&&M.storeMultisampledDepthBuffer===!1&&l){let x=M.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;n.invalidateFramebuffer(n.DRAW_FRAMEBUFFER,[x])}}}function Et(M){return Math.min(s.maxSamples,M.samples)}function fe(M){let x=i.get(M);return M.samples>0&&e.has("WEBGL_multisampled_render_to_texture")===!0&&x.__useRenderToTexture!==!1}function Gt(M){let x=o.render.frame;u.get(M)!==x&&(u.set(M,x),M.update())}function Fe(M,x){let V=M.colorSpace,te=M.format,j=M.type;return M.isCompressedTexture===!0||M.isVideoTexture===!0||V!==xo&&V!==Oi&&(je.getTransfer(V)===ct?(te!==Hn||j!==Mn)&&Ne("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):Pe("WebGLTextures: Unsupported texture color space:",V)),x}function Ge(M){return typeof HTMLImageElement<"u"&&M instanceof HTMLImageElement?(c.width=M.naturalWidth||M.width,c.height=M.naturalHeight||M.height):typeof VideoFrame<"u"&&M instanceof VideoFrame?(c.width=M.displayWidth,c.height=M.displayHeight):(c.width=M.width,c.height=M.height),c}this.allocateTextureUnit=Oe,this.resetTextureUnits=$,this.getTextureUnits=ee,this.setTextureUnits=Me,this.setTexture2D=ye,this.setTexture2DArray=Se,this.setTexture3D=Le,this.setTextureCube=be,this.rebindTextures=Pn,this.setupRenderTarget=Dn,this.updateRenderTargetMipmap=U,this.updateMultisampleRenderTarget=_t,this.setupDepthRenderbuffer=Un,this.setupFrameBufferTexture=Rt,this.useMultisampledRTT=fe,this.dispose=X}function Sw(n,e){function t(i,s=Oi){let r,o=je.getTransfer(s);if(i===Mn)return n.UNSIGNED_BYTE;if(i===uc)return n.UNSIGNED_SHORT_4_4_4_4;if(i===dc)return n.UNSIGNED_SHORT_5_5_5_1;if(i===Sh)return n.UNSIGNED_INT_5_9_9_9_REV;if(i===_h)return n.UNSIGNED_INT_10F_11F_11F_REV;if(i===xh)return n.BYTE;if(i===vh)return n.SHORT;if(i===Tr)return n.UNSIGNED_SHORT;if(i===cc)return n.INT;if(i===ci)return n.UNSIGNED_INT;if(i===Zn)return n.FLOAT;if(i===ui)return n.HALF_FLOAT;if(i===Eh)return n.ALPHA;if(i===Ah)return n.RGB;if(i===Hn)return n.RGBA;if(i===Fi)return n.DEPTH_COMPONENT;if(i===Vi)return n.DEPTH_STENCIL;if(i===Mh)return n.RED;if(i===hc)return n.RED_INTEGER;if(i===os)return n.RG;if(i===pc)return n.RG_INTEGER;if(i===fc)return n.RGBA_INTEGER;if(i===Jo||i===Qo||i===Ko||i===qo)if(o===ct)if(r=e.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(i===Jo)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(i===Qo)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(i===Ko)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(i===qo)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=e.get("WEBGL_compressed_texture_s3tc"),r!==null){if(i===Jo)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(i===Qo)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(i===Ko)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(i===qo)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(i===mc||i===gc||i===yc||i===bc)if(r=e.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(i===mc)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(i===gc)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(i===yc)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(i===bc)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(i===xc||i===vc||i===Sc||i===_c||i===Ec||i===jo||i===Ac)if(r=e.get("WEBGL_compressed_texture_etc"),r!==null){if(i===xc||i===vc)return o===ct?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(i===Sc)return o===ct?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(i===_c)return r.COMPRESSED_R11_EAC;if(i===Ec)return r.COMPRESSED_SIGNED_R11_EAC;if(i===jo)return r.COMPRESSED_RG11_EAC;if(i===Ac)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(i===Mc||i===Rc||i===wc||i===Tc||i===Cc||i===Ic||i===Nc||i===Bc||i===Lc||i===Fc||i===Uc||i===Pc||i===Dc||i===Gc)if(r=e.get("WEBGL_compressed_texture_astc"),r!==null){if(i===Mc)return o===ct?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(i===Rc)return o===ct?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(i===wc)return o===ct?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(i===Tc)return o===ct?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(i===Cc)return o===ct?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(i===Ic)return o===ct?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(i===Nc)return o===ct?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(i===Bc)return o===ct?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(i===Lc)return o===ct?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(i===Fc)return o===ct?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(i===Uc)return o===ct?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(i===Pc)return o===ct?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(i===Dc)return o===ct?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(i===Gc)return o===ct?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(i===Vc||i===Oc||i===kc)if(r=e.get("EXT_texture_compression_bptc"),r!==null){if(i===Vc)return o===ct?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(i===Oc)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(i===kc)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(i===Wc||i===zc||i===$o||i===Xc)if(r=e.get("EXT_texture_compression_rgtc"),r!==null){if(i===Wc)return r.COMPRESSED_RED_RGTC1_EXT;if(i===zc)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(i===$o)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(i===Xc)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return i===Cs?n.UNSIGNED_INT_24_8:n[i]!==void 0?n[i]:null}return{convert:t}}var _w=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,Ew=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,Hh=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(e,t){if(this.texture===null){let i=new Lo(e.texture);(e.depthNear!==t.depthNear||e.depthFar!==t.depthFar)&&(this.depthNear=e.depthNear,this.depthFar=e.depthFar),this.texture=i}}getMesh(e){if(this.texture!==null&&this.mesh===null){let t=e.cameras[0].viewport,i=new bi({vertexShader:_w,fragmentShader:Ew,uniforms:{depthColor:{value:this.texture},depthWidth:{value:t.z},depthHeight:{value:t.w}}});this.mesh=new Mt(new Pi(20,20),i)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},Yh=class extends ri{constructor(e,t){super();let i=this,s=null,r=1,o=null,a="local-floor",l=1,c=null,u=null,h=null,p=null,d=null,f=null,b=typeof XRWebGLBinding<"u",g=new Hh,m={},S=t.getContextAttributes(),A=null,_=null,w=[],R=[],y=new Be,E=null,L=null,C=new mn;C.viewport=new mt;let P=new mn;P.viewport=new mt;let D=[C,P],W=new sc,I=null,X=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(K){let ye=w[K];return ye===void 0&&(ye=new vr,w[K]=ye),ye.getTargetRaySpace()},this.getControllerGrip=function(K){let ye=w[K];return ye===void 0&&(ye=new vr,w[K]=ye),ye.getGripSpace()},this.getHand=function(K){let ye=w[K];return ye===void 0&&(ye=new vr,w[K]=ye),ye.getHandSpace()};function Y(K){let ye=R.indexOf(K.inputSource);if(ye===-1)return;let Se=w[ye];Se!==void 0&&(Se.update(K.inputSource,K.frame,c||o),Se.dispatchEvent({type:K.type,data:K.inputSource}))}function z(){s.removeEventListener("select",Y),s.removeEventListener("selectstart",Y),s.removeEventListener("selectend",Y),s.removeEventListener("squeeze",Y),s.removeEventListener("squeezestart",Y),s.removeEventListener("squeezeend",Y),s.removeEventListener("end",z),s.removeEventListener("inputsourceschange",ne);for(let K=0;K<w.length;K++){let ye=R[K];ye!==null&&(R[K]=null,w[K].disconnect(ye))}I=null,X=null,g.reset();for(let K in m)delete m[K];if(e.setRenderTarget(A),d=null,p=null,h=null,s=null,_=null,Oe.stop(),i.isPresenting=!1,e.setPixelRatio(E),e.setSize(y.width,y.height,!1),L!==null){let K=L.camera;K.fov=L.fov,K.zoom=L.zoom,K.updateProjectionMatrix(),L=null}i.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(K){r=K,i.isPresenting===!0&&Ne("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(K){a=K,i.isPresenting===!0&&Ne("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||o},this.setReferenceSpace=function(K){c=K},this.getBaseLayer=function(){return p!==null?p:d},this.getBinding=function(){return h===null&&b&&(h=new XRWebGLBinding(s,t)),h},this.getFrame=function(){return f},this.getSession=function(){return s},this.setSession=async function(K){if(s=K,s!==null){if(A=e.getRenderTarget(),s.addEventListener("select",Y),s.addEventListener("selectstart",Y),s.addEventListener("selectend",Y),s.addEventListener("squeeze",Y),s.addEventListener("squeezestart",Y),s.addEventListener("squeezeend",Y),s.addEventListener("end",z),s.addEventListener("inputsourceschange",ne),S.xrCompatible!==!0&&await t.makeXRCompatible(),E=e.getPixelRatio(),e.getSize(y),b&&"createProjectionLayer"in XRWebGLBinding.prototype){let Se=null,Le=null,be=null;S.depth&&(be=S.stencil?t.DEPTH24_STENCIL8:t.DEPTH_COMPONENT24,Se=S.stencil?Vi:Fi,Le=S.stencil?Cs:ci);let ze={colorFormat:t.RGBA8,depthFormat:be,scaleFactor:r};h=this.getBinding(),p=h.createProjectionLayer(ze),s.updateRenderState({layers:[p]}),e.setPixelRatio(1),e.setSize(p.textureWidth,p.textureHeight,!1),_=new Bn(p.textureWidth,p.textureHeight,{format:Hn,type:Mn,depthTexture:new Ui(p.textureWidth,p.textureHeight,Le,void 0,void 0,void 0,void 0,void 0,void 0,Se),stencilBuffer:S.stencil,colorSpace:e.outputColorSpace,samples:S.antialias?4:0,resolveDepthBuffer:p.ignoreDepthValues===!1,resolveStencilBuffer:p.ignoreDepthValues===!1,storeMultisampledDepthBuffer:p.ignoreDepthValues===!1,storeMultisampledStencilBuffer:p.ignoreDepthValues===!1})}else{let Se={antialias:S.antialias,alpha:!0,depth:S.depth,stencil:S.stencil,framebufferScaleFactor:r};d=new XRWebGLLayer(s,t,Se),s.updateRenderState({baseLayer:d}),e.setPixelRatio(1),e.setSize(d.framebufferWidth,d.framebufferHeight,!1),_=new Bn(d.framebufferWidth,d.framebufferHeight,{format:Hn,type:Mn,colorSpace:e.outputColorSpace,stencilBuffer:S.stencil,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}_.isXRRenderTarget=!0,this.setFoveation(l),c=null,o=await s.requestReferenceSpace(a),Oe.setContext(s),Oe.start(),i.isPresenting=!0,i.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return g.getDepthTexture()};function ne(K){for(let ye=0;ye<K.removed.length;ye++){let Se=K.removed[ye],Le=R.indexOf(Se);Le>=0&&(R[Le]=null,w[Le].disconnect(Se))}for(let ye=0;ye<K.added.length;ye++){let Se=K.added[ye],Le=R.indexOf(Se);if(Le===-1){for(let ze=0;ze<w.length;ze++)if(ze>=R.length){R.push(Se),Le=ze;break}else if(R[ze]===null){R[ze]=Se,Le=ze;break}if(Le===-1)break}let be=w[Le];be&&be.connect(Se)}}function H(K,ye){ye===null?K.matrixWorld.copy(K.matrix):K.matrixWorld.multiplyMatrices(ye.matrixWorld,K.matrix),K.matrixWorldInverse.copy(K.matrixWorld).invert()}this.updateCamera=function(K){if(s===null)return;let ye=K.near,Se=K.far;g.texture!==null&&(g.depthNear>0&&(ye=g.depthNear),g.depthFar>0&&(Se=g.depthFar)),W.near=P.near=C.near=ye,W.far=P.far=C.far=Se,(I!==W.near||X!==W.far)&&(s.updateRenderState({depthNear:W.near,depthFar:W.far}),I=W.near,X=W.far),W.layers.mask=K.layers.mask|6,C.layers.mask=W.layers.mask&-5,P.layers.mask=W.layers.mask&-3;let Le=K.parent,be=W.cameras;H(W,Le);for(let ze=0;ze<be.length;ze++)H(be[ze],Le);W.projectionMatrix.copy(C.projectionMatrix),W.projectionMatrixInverse.copy(C.projectionMatrixInverse),L===null&&K.isPerspectiveCamera&&(L={camera:K,fov:K.fov,zoom:K.zoom}),$(K,W,Le)};function $(K,ye,Se){Se===null?K.matrix.copy(ye.matrixWorld):(K.matrix.copy(Se.matrixWorld),K.matrix.invert(),K.matrix.multiply(ye.matrixWorld)),K.matrix.decompose(K.position,K.quaternion,K.scale),K.updateMatrixWorld(!0),K.projectionMatrix.copy(ye.projectionMatrix),K.projectionMatrixInverse.copy(ye.projectionMatrixInverse),K.isPerspectiveCamera&&(K.fov=yr*2*Math.atan(1/K.projectionMatrix.elements[5]),K.zoom=1)}this.getCamera=function(){return W},this.getFoveation=function(){if(!(p===null&&d===null))return l},this.setFoveation=function(K){l=K,p!==null&&(p.fixedFoveation=K),d!==null&&d.fixedFoveation!==void 0&&(d.fixedFoveation=K)},this.hasDepthSensing=function(){return g.texture!==null},this.getDepthSensingMesh=function(){return g.getMesh(W)},this.getCameraTexture=function(K){return m[K]};let ee=null;function Me(K,ye){if(u=ye.getViewerPose(c||o),f=ye,u!==null){let Se=u.views;d!==null&&(e.setRenderTargetFramebuffer(_,d.framebuffer),e.setRenderTarget(_));let Le=!1;Se.length!==W.cameras.length&&(W.cameras.length=0,Le=!0);for(let Ue=0;Ue<Se.length;Ue++){let dt=Se[Ue],gt=null;if(d!==null)gt=d.getViewport(dt);else{let Kt=h.getViewSubImage(p,dt);gt=Kt.viewport,Ue===0&&(e.setRenderTargetTextures(_,Kt.colorTexture,Kt.depthStencilTexture),e.setRenderTarget(_))}let Qe=D[Ue];Qe===void 0&&(Qe=new mn,Qe.layers.enable(Ue),Qe.viewport=new mt,D[Ue]=Qe),Qe.matrix.fromArray(dt.transform.matrix),Qe.matrix.decompose(Qe.position,Qe.quaternion,Qe.scale),Qe.projectionMatrix.fromArray(dt.projectionMatrix),Qe.projectionMatrixInverse.copy(Qe.projectionMatrix).invert(),Qe.viewport.set(gt.x,gt.y,gt.width,gt.height),Ue===0&&(W.matrix.copy(Qe.matrix),W.matrix.decompose(W.position,W.quaternion,W.scale)),Le===!0&&W.cameras.push(Qe)}let be=s.enabledFeatures;if(be&&be.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&b){h=i.getBinding();let Ue=h.getDepthInformation(Se[0]);Ue&&Ue.isValid&&Ue.texture&&g.init(Ue,s.renderState)}if(be&&be.includes("camera-access")&&b){e.state.unbindTexture(),h=i.getBinding();for(let Ue=0;Ue<Se.length;Ue++){let dt=Se[Ue].camera;if(dt){let gt=m[dt];gt||(gt=new Lo,m[dt]=gt);let Qe=h.getCameraImage(dt);gt.sourceTexture=Qe}}}}for(let Se=0;Se<w.length;Se++){let Le=R[Se],be=w[Se];Le!==null&&be!==void 0&&be.update(Le,ye,c||o)}ee&&ee(K,ye),ye.detectedPlanes&&i.dispatchEvent({type:"planesdetected",data:ye}),f=null}let Oe=new Lb;Oe.setAnimationLoop(Me),this.setAnimationLoop=function(K){ee=K},this.dispose=function(){}}},Aw=new Ye,zb=new De;zb.set(-1,0,0,0,1,0,0,0,1);function Mw(n,e){function t(g,m){g.matrixAutoUpdate===!0&&g.updateMatrix(),m.value.copy(g.matrix)}function i(g,m){m.color.getRGB(g.fogColor.value,Fh(n)),m.isFog?(g.fogNear.value=m.near,g.fogFar.value=m.far):m.isFogExp2&&(g.fogDensity.value=m.density)}function s(g,m,S,A,_){m.isNodeMaterial?m.uniformsNeedUpdate=!1:m.isMeshBasicMaterial?r(g,m):m.isMeshLambertMaterial?(r(g,m),m.envMap&&(g.envMapIntensity.value=m.envMapIntensity)):m.isMeshToonMaterial?(r(g,m),h(g,m)):m.isMeshPhongMaterial?(r(g,m),u(g,m),m.envMap&&(g.envMapIntensity.value=m.envMapIntensity)):m.isMeshStandardMaterial?(r(g,m),p(g,m),m.isMeshPhysicalMaterial&&d(g,m,_)):m.isMeshMatcapMaterial?(r(g,m),f(g,m)):m.isMeshDepthMaterial?r(g,m):m.isMeshDistanceMaterial?(r(g,m),b(g,m)):m.isMeshNormalMaterial?r(g,m):m.isLineBasicMaterial?(o(g,m),m.isLineDashedMaterial&&a(g,m)):m.isPointsMaterial?l(g,m,S,A):m.isSpriteMaterial?c(g,m):m.isShadowMaterial?(g.color.value.copy(m.color),g.opacity.value=m.opacity):m.isShaderMaterial&&(m.uniformsNeedUpdate=!1)}function r(g,m){g.opacity.value=m.opacity,m.color&&g.diffuse.value.copy(m.color),m.emissive&&g.emissive.value.copy(m.emissive).multiplyScalar(m.emissiveIntensity),m.map&&(g.map.value=m.map,t(m.map,g.mapTransform)),m.alphaMap&&(g.alphaMap.value=m.alphaMap,t(m.alphaMap,g.alphaMapTransform)),m.bumpMap&&(g.bumpMap.value=m.bumpMap,t(m.bumpMap,g.bumpMapTransform),g.bumpScale.value=m.bumpScale,m.side===bn&&(g.bumpScale.value*=-1)),m.normalMap&&(g.normalMap.value=m.normalMap,t(m.normalMap,g.normalMapTransform),g.normalScale.value.copy(m.normalScale),m.side===bn&&g.normalScale.value.negate()),m.displacementMap&&(g.displacementMap.value=m.displacementMap,t(m.displacementMap,g.displacementMapTransform),g.displacementScale.value=m.displacementScale,g.displacementBias.value=m.displacementBias),m.emissiveMap&&(g.emissiveMap.value=m.emissiveMap,t(m.emissiveMap,g.emissiveMapTransform)),m.specularMap&&(g.specularMap.value=m.specularMap,t(m.specularMap,g.specularMapTransform)),m.alphaTest>0&&(g.alphaTest.value=m.alphaTest);let S=e.get(m),A=S.envMap,_=S.envMapRotation;A&&(g.envMap.value=A,g.envMapRotation.value.setFromMatrix4(Aw.makeRotationFromEuler(_)).transpose(),A.isCubeTexture&&A.isRenderTargetTexture===!1&&g.envMapRotation.value.premultiply(zb),g.reflectivity.value=m.reflectivity,g.ior.value=m.ior,g.refractionRatio.value=m.refractionRatio),m.lightMap&&(g.lightMap.value=m.lightMap,g.lightMapIntensity.value=m.lightMapIntensity,t(m.lightMap,g.lightMapTransform)),m.aoMap&&(g.aoMap.value=m.aoMap,g.aoMapIntensity.value=m.aoMapIntensity,t(m.aoMap,g.aoMapTransform))}function o(g,m){g.diffuse.value.copy(m.color),g.opacity.value=m.opacity,m.map&&(g.map.value=m.map,t(m.map,g.mapTransform))}function a(g,m){g.dashSize.value=m.dashSize,g.totalSize.value=m.dashSize+m.gapSize,g.scale.value=m.scale}function l(g,m,S,A){g.diffuse.value.copy(m.color),g.opacity.value=m.opacity,g.size.value=m.size*S,g.scale.value=A*.5,m.map&&(g.map.value=m.map,t(m.map,g.uvTransform)),m.alphaMap&&(g.alphaMap.value=m.alphaMap,t(m.alphaMap,g.alphaMapTransform)),m.alphaTest>0&&(g.alphaTest.value=m.alphaTest)}function c(g,m){g.diffuse.value.copy(m.color),g.opacity.value=m.opacity,g.rotation.value=m.rotation,m.map&&(g.map.value=m.map,t(m.map,g.mapTransform)),m.alphaMap&&(g.alphaMap.value=m.alphaMap,t(m.alphaMap,g.alphaMapTransform)),m.alphaTest>0&&(g.alphaTest.value=m.alphaTest)}function u(g,m){g.specular.value.copy(m.specular),g.shininess.value=Math.max(m.shininess,1e-4)}function h(g,m){m.gradientMap&&(g.gradientMap.value=m.gradientMap)}function p(g,m){g.metalness.value=m.metalness,m.metalnessMap&&(g.metalnessMap.value=m.metalnessMap,t(m.metalnessMap,g.metalnessMapTransform)),g.roughness.value=m.roughness,m.roughnessMap&&(g.roughnessMap.value=m.roughnessMap,t(m.roughnessMap,g.roughnessMapTransform)),m.envMap&&(g.envMapIntensity.value=m.envMapIntensity)}function d(g,m,S){g.ior.value=m.ior,m.diffuseRoughness>0&&(g.diffuseRoughness.value=m.diffuseRoughness,m.diffuseRoughnessMap&&(g.diffuseRoughnessMap.value=m.diffuseRoughnessMap,t(m.diffuseRoughnessMap,g.diffuseRoughnessMapTransform))),m.sheen>0&&(g.sheenColor.value.copy(m.sheenColor).multiplyScalar(m.sheen),g.sheenRoughness.value=m.sheenRoughness,m.sheenColorMap&&(g.sheenColorMap.value=m.sheenColorMap,t(m.sheenColorMap,g.sheenColorMapTransform)),m.sheenRoughnessMap&&(g.sheenRoughnessMap.value=m.sheenRoughnessMap,t(m.sheenRoughnessMap,g.sheenRoughnessMapTransform))),m.clearcoat>0&&(g.clearcoat.value=m.clearcoat,g.clearcoatRoughness.value=m.clearcoatRoughness,m.clearcoatMap&&(g.clearcoatMap.value=m.clearcoatMap,t(m.clearcoatMap,g.clearcoatMapTransform)),m.clearcoatRoughnessMap&&(g.clearcoatRoughnessMap.value=m.clearcoatRoughnessMap,t(m.clearcoatRoughnessMap,g.clearcoatRoughnessMapTransform)),m.clearcoatNormalMap&&(g.clearcoatNormalMap.value=m.clearcoatNormalMap,t(m.clearcoatNormalMap,g.clearcoatNormalMapTransform),g.clearcoatNormalScale.value.copy(m.clearcoatNormalScale),m.side===bn&&g.clearcoatNormalScale.value.negate())),m.dispersion>0&&(g.dispersion.value=m.dispersion),m.retroreflectivity>0&&(g.retroreflectivity.value=m.retroreflectivity),m.iridescence>0&&(g.iridescence.value=m.iridescence,g.iridescenceIOR.value=m.iridescenceIOR,g.iridescenceThicknessMinimum.value=m.iridescenceThicknessMinimum,g.iridescenceThicknessMaximum.value=m.iridescenceThicknessMaximum,m.iridescenceMap&&(g.iridescenceMap.value=m.iridescenceMap,t(m.iridescenceMap,g.iridescenceMapTransform)),m.iridescenceThicknessMap&&(g.iridescenceThicknessMap.value=m.iridescenceThicknessMap,t(m.iridescenceThicknessMap,g.iridescenceThicknessMapTransform))),m.transmission>0&&(g.transmission.value=m.transmission,g.transmissionSamplerMap.value=S.texture,g.transmissionSamplerSize.value.set(S.width,S.height),m.transmissionMap&&(g.transmissionMap.value=m.transmissionMap,t(m.transmissionMap,g.transmissionMapTransform)),g.thickness.value=m.thickness,m.thicknessMap&&(g.thicknessMap.value=m.thicknessMap,t(m.thicknessMap,g.thicknessMapTransform)),g.attenuationDistance.value=m.attenuationDistance,g.attenuationColor.value.copy(m.attenuationColor)),m.anisotropy>0&&(g.anisotropyVector.value.set(m.anisotropy*Math.cos(m.anisotropyRotation),m.anisotropy*Math.sin(m.anisotropyRotation)),m.anisotropyMap&&(g.anisotropyMap.value=m.anisotropyMap,t(m.anisotropyMap,g.anisotropyMapTransform))),g.specularIntensity.value=m.specularIntensity,g.specularColor.value.copy(m.specularColor),m.specularColorMap&&(g.specularColorMap.value=m.specularColorMap,t(m.specularColorMap,g.specularColorMapTransform)),m.specularIntensityMap&&(g.specularIntensityMap.value=m.specularIntensityMap,t(m.specularIntensityMap,g.specularIntensityMapTransform))}function f(g,m){m.matcap&&(g.matcap.value=m.matcap)}function b(g,m){let S=e.get(m).light;g.referencePosition.value.setFromMatrixPosition(S.matrixWorld),g.nearDistance.value=S.shadow.camera.near,g.farDistance.value=S.shadow.camera.far}return{refreshFogUniforms:i,refreshMaterialUniforms:s}}function Rw(n,e,t,i){let s={},r={};function o(S,A){let _=A.program;i.uniformBlockBinding(S,_,s[S.id])}function a(S,A){let _=s[S.id];_===void 0&&(f(S),_=l(S),s[S.id]=_,S.addEventListener("dispose",g));let w=A.program;i.updateUBOMapping(S,w);let R=e.render.frame;r[S.id]!==R&&(c(S),r[S.id]=R)}function l(S){let A=n.createBuffer(),_=S.__size,w=S.usage;return n.bindBuffer(n.UNIFORM_BUFFER,A),n.bufferData(n.UNIFORM_BUFFER,_,w),n.bindBuffer(n.UNIFORM_BUFFER,null),A}function c(S){let A=s[S.id],_=S.uniforms,w=S.__cache;n.bindBuffer(n.UNIFORM_BUFFER,A);for(let R=0,y=_.length;R<y;R++){let E=_[R];if(Array.isArray(E))for(let L=0,C=E.length;L<C;L++)u(E[L],R,L,w);else u(E,R,0,w)}n.bindBuffer(n.UNIFORM_BUFFER,null)}function u(S,A,_,w){if(p(S,A,_,w)===!0){let R=S.__offset,y=S.value;if(Array.isArray(y)){let E=0;for(let L=0;L<y.length;L++){let C=y[L],P=b(C,!0);h(C,S.__data,E),E+=P.storage/Float32Array.BYTES_PER_ELEMENT}}else h(y,S.__data,0);n.bufferSubData(n.UNIFORM_BUFFER,R,S.__data)}}function h(S,A,_){typeof S=="number"||typeof S=="boolean"?A[_]=S:S.isMatrix3?(A[_]=S.elements[0],A[_+1]=S.elements[1],A[_+2]=S.elements[2],A[_+3]=0,A[_+4]=S.elements[3],A[_+5]=S.elements[4],A[_+6]=S.elements[5],A[_+7]=0,A[_+8]=S.elements[6],A[_+9]=S.elements[7],A[_+10]=S.elements[8],A[_+11]=0):ArrayBuffer.isView(S)?A.set(S.subarray(0,A.length-_),_):S.toArray(A,_)}function p(S,A,_,w){let R=S.value,y=A+"_"+_;if(Array.isArray(R)){w[y]===void 0&&(w[y]=[]);let E=w[y],L=!1;for(let C=0;C<R.length;C++)d(R[C],E,C)===!0&&(L=!0);return L}return d(R,w,y)}function d(S,A,_){if(A[_]===void 0)return typeof S=="number"||typeof S=="boolean"?A[_]=S:ArrayBuffer.isView(S)?A[_]=S.slice():A[_]=S.clone(),!0;{let w=A[_];if(typeof S=="number"||typeof S=="boolean"){if(w!==S)return A[_]=S,!0}else{if(ArrayBuffer.isView(S))return!0;if(w.equals(S)===!1)return w.copy(S),!0}}return!1}function f(S){let A=S.uniforms,_=0,w=16;for(let y=0,E=A.length;y<E;y++){let L=Array.isArray(A[y])?A[y]:[A[y]];for(let C=0,P=L.length;C<P;C++){let D=L[C],W=Array.isArray(D.value)?D.value:[D.value],I=Array.isArray(A[y])||Array.isArray(D.value),X=_;for(let z=0,ne=W.length;z<ne;z++){let H=W[z],$=b(H,I),ee=_%w,Me=ee%$.boundary,Oe=ee+Me;_+=Me,Oe!==0&&w-Oe<$.storage&&(_+=w-Oe),z===0&&(X=_),_+=$.storage}let Y=D.type==="int"?Int32Array:D.type==="uint"?Uint32Array:Float32Array;D.__data=new Y((_-X)/Float32Array.BYTES_PER_ELEMENT),D.__offset=X}}let R=_%w;return R>0&&(_+=w-R),S.__size=_,S.__cache={},this}function b(S,A){let _={boundary:0,storage:0};return typeof S=="number"||typeof S=="boolean"?(_.boundary=4,_.storage=4):S.isVector2?(_.boundary=8,_.storage=8):S.isVector3||S.isColor?(_.boundary=16,_.storage=12):S.isVector4?(_.boundary=16,_.storage=16):S.isMatrix3?(_.boundary=16,_.storage=48):S.isMatrix4?(_.boundary=16,_.storage=64):S.isTexture?Ne("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(S)?(_.boundary=16,_.storage=S.byteLength):Ne("WebGLRenderer: Unsupported uniform value type.",S),A===!0&&(_.boundary=16,_.storage=Math.ceil(_.storage/16)*16),_}function g(S){let A=S.target;A.removeEventListener("dispose",g),n.deleteBuffer(s[A.id]),delete s[A.id],delete r[A.id]}function m(){for(let S in s)n.deleteBuffer(s[S]);s={},r={}}return{bind:o,update:a,dispose:m}}var ww=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),vi=null;function Tw(){return vi===null&&(vi=new wo(ww,16,16,os,ui),vi.name="DFG_LUT",vi.minFilter=gn,vi.magFilter=gn,vi.wrapS=fi,vi.wrapT=fi,vi.generateMipmaps=!1,vi.needsUpdate=!0),vi}var Jc=class{constructor(e={}){let{canvas:t=nb(),context:i=null,depth:s=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:u="default",failIfMajorPerformanceCaveat:h=!1,reversedDepthBuffer:p=!1,outputBufferType:d=Mn}=e;this.isWebGLRenderer=!0;let f;if(i!==null){if(typeof WebGLRenderingContext<"u"&&i instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");f=i.getContextAttributes().alpha}else f=o;let b=d,g=new Set([fc,pc,hc]),m=new Set([Mn,ci,Tr,Cs,uc,dc]),S=new Uint32Array(4),A=new Int32Array(4),_={textures:[],min:[],max:[],resolution:[]},w=null,R=null,y=[],E=[],L=null;this.domElement=t,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=xi,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let C=this,P=!1,D=null,W=null,I=null,X=null;this._outputColorSpace=pn;let Y=0,z=0,ne=null,H=-1,$=null,ee=new mt,Me=new mt,Oe=null,K=new We(0),ye=0,Se=t.width,Le=t.height,be=1,ze=null,Nt=null,Ue=new mt(0,0,Se,Le),dt=new mt(0,0,Se,Le),gt=!1,Qe=new $i,Kt=new kl,Dt=!1,Sn=!1,Rt=new Ye,di=new F,Xt=new mt,Un={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},Pn=!1;function Dn(){return ne===null?be:1}let U=i;function Gn(v,B){return t.getContext(v,B)}let _t,Et,fe,Gt,Fe,Ge,M,x,V,te,j,ae,he,J,Q,ce,T,q,Z,ue,oe,le,we;try{let v={alpha:!0,depth:s,stencil:r,antialias:a,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:u,failIfMajorPerformanceCaveat:h};if("setAttribute"in t&&t.setAttribute("data-engine",`three.js r${"187"}`),t.addEventListener("webglcontextlost",Ce,!1),t.addEventListener("webglcontextrestored",Xe,!1),t.addEventListener("webglcontextcreationerror",me,!1),U===null){let B="webgl2";if(U=Gn(B,v),U===null)throw Gn(B)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}Ze()}catch(v){throw t.removeEventListener("webglcontextlost",Ce,!1),t.removeEventListener("webglcontextrestored",Xe,!1),t.removeEventListener("webglcontextcreationerror",me,!1),Pe("WebGLRenderer: "+v.message),v}function Ze(){_t=new VM(U),_t.init(),oe=new Sw(U,_t),Et=new TM(U,_t,e,oe),fe=new xw(U,_t),Et.reversedDepthBuffer&&p&&fe.buffers.depth.setReversed(!0),W=U.createFramebuffer(),I=U.createFramebuffer(),X=U.createFramebuffer(),Gt=new WM(U),Fe=new rw,Ge=new vw(U,_t,fe,Fe,Et,oe,Gt),M=new GM(C),x=new X_(U),le=new RM(U,x),V=new OM(U,x,Gt,le),te=new XM(U,V,x,le,Gt),q=new zM(U,Et,Ge),Q=new CM(Fe),j=new sw(C,M,_t,Et,le,Q),ae=new Mw(C,Fe),he=new aw,J=new pw(_t),T=new MM(C,M,fe,te,f,l),ce=new bw(C,te,Et),we=new Rw(U,Gt,Et,fe),Z=new wM(U,_t,Gt),ue=new kM(U,_t,Gt),Gt.programs=j.programs,C.capabilities=Et,C.extensions=_t,C.properties=Fe,C.renderLists=he,C.shadowMap=ce,C.state=fe,C.info=Gt}b!==Mn&&(L=new HM(b,t.width,t.height,a,s,r));let ie=new Yh(C,U);this.xr=ie,this.getContext=function(){return U},this.getContextAttributes=function(){return U.getContextAttributes()},this.forceContextLoss=function(){let v=_t.get("WEBGL_lose_context");v&&v.loseContext()},this.forceContextRestore=function(){let v=_t.get("WEBGL_lose_context");v&&v.restoreContext()},this.getPixelRatio=function(){return be},this.setPixelRatio=function(v){v!==void 0&&(be=v,this.setSize(Se,Le,!1))},this.getSize=function(v){return v.set(Se,Le)},this.setSize=function(v,B,k=!0){if(ie.isPresenting){Ne("WebGLRenderer: Can't change size while VR device is presenting.");return}Se=v,Le=B,t.width=Math.floor(v*be),t.height=Math.floor(B*be),k===!0&&(t.style.width=v+"px",t.style.height=B+"px"),L!==null&&L.setSize(t.width,t.height),this.setViewport(0,0,v,B)},this.getDrawingBufferSize=function(v){return v.set(Se*be,Le*be).floor()},this.setDrawingBufferSize=function(v,B,k){Se=v,Le=B,be=k,t.width=Math.floor(v*k),t.height=Math.floor(B*k),this.setViewport(0,0,v,B)},this.setEffects=function(v){if(b===Mn){Pe("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(v){for(let B=0;B<v.length;B++)if(v[B].isOutputPass===!0){Ne("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}L.setEffects(v||[])},this.getCurrentViewport=function(v){return v.copy(ee)},this.getViewport=function(v){return v.copy(Ue)},this.setViewport=function(v,B,k,G){v.isVector4?Ue.set(v.x,v.y,v.z,v.w):Ue.set(v,B,k,G),fe.viewport(ee.copy(Ue).multiplyScalar(Dn()).round())},this.getScissor=function(v){return v.copy(dt)},this.setScissor=function(v,B,k,G){v.isVector4?dt.set(v.x,v.y,v.z,v.w):dt.set(v,B,k,G),fe.scissor(Me.copy(dt).multiplyScalar(Dn()).round())},this.getScissorTest=function(){return gt},this.setScissorTest=function(v){fe.setScissorTest(gt=v)},this.setOpaqueSort=function(v){ze=v},this.setTransparentSort=function(v){Nt=v},this.getClearColor=function(v){return v.copy(T.getClearColor())},this.setClearColor=function(){T.setClearColor(...arguments)},this.getClearAlpha=function(){return T.getClearAlpha()},this.setClearAlpha=function(){T.setClearAlpha(...arguments)},this.clear=function(v=!0,B=!0,k=!0){let G=0;if(v){let O=!1;if(ne!==null){let pe=ne.texture.format;O=g.has(pe)}if(O){let pe=ne.texture.type,ve=m.has(pe),de=T.getClearColor(),xe=T.getClearAlpha(),Re=de.r,ke=de.g,Ke=de.b;ve?(S[0]=Re,S[1]=ke,S[2]=Ke,S[3]=xe,U.clearBufferuiv(U.COLOR,0,S)):(A[0]=Re,A[1]=ke,A[2]=Ke,A[3]=xe,U.clearBufferiv(U.COLOR,0,A))}else G|=U.COLOR_BUFFER_BIT}B&&(G|=U.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),k&&(G|=U.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),G!==0&&U.clear(G)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(v){v.setRenderer(this),D=v},this.dispose=function(){t.removeEventListener("webglcontextlost",Ce,!1),t.removeEventListener("webglcontextrestored",Xe,!1),t.removeEventListener("webglcontextcreationerror",me,!1),T.dispose(),he.dispose(),J.dispose(),Ge.dispose(),Fe.dispose(),M.dispose(),te.dispose(),V.dispose(),le.dispose(),we.dispose(),j.dispose(),ie.dispose(),ie.removeEventListener("sessionstart",Ip),ie.removeEventListener("sessionend",Np),ds.stop()};function Ce(v){v.preventDefault(),Ih("WebGLRenderer: Context Lost."),P=!0}function Xe(){Ih("WebGLRenderer: Context Restored."),P=!1;let v=Gt.autoReset,B=ce.enabled,k=ce.autoUpdate,G=ce.needsUpdate,O=ce.type;Ze(),Gt.autoReset=v,ce.enabled=B,ce.autoUpdate=k,ce.needsUpdate=G,ce.type=O}function me(v){Pe("WebGLRenderer: A WebGL context could not be created. Reason: ",v.statusMessage)}function ht(v){let B=v.target;B.removeEventListener("dispose",ht),Zt(B)}function Zt(v){zi(v),Fe.remove(v)}function zi(v){let B=Fe.get(v).programs;B!==void 0&&(B.forEach(function(k){j.releaseProgram(k)}),v.isShaderMaterial&&j.releaseShaderCache(v))}this.renderBufferDirect=function(v,B,k,G,O,pe){B===null&&(B=Un);let ve=O.isMesh&&O.matrixWorld.determinantAffine()<0,de=ax(v,B,k,G,O);fe.setMaterial(G,ve);let xe=k.index,Re=1;if(G.wireframe===!0){if(xe=V.getWireframeAttribute(k),xe===void 0)return;Re=2}let ke=k.drawRange,Ke=k.attributes.position,_e=ke.start*Re,qe=(ke.start+ke.count)*Re;pe!==null&&(_e=Math.max(_e,pe.start*Re),qe=Math.min(qe,(pe.start+pe.count)*Re)),xe!==null?(_e=Math.max(_e,0),qe=Math.min(qe,xe.count)):Ke!=null&&(_e=Math.max(_e,0),qe=Math.min(qe,Ke.count));let Bt=qe-_e;if(Bt<0||Bt===1/0)return;le.setup(O,G,de,k,xe);let bt,yt=Z;if(xe!==null&&(bt=x.get(xe),yt=ue,yt.setIndex(bt)),O.isMesh)G.wireframe===!0?(fe.setLineWidth(G.wireframeLinewidth*Dn()),yt.setMode(U.LINES)):yt.setMode(U.TRIANGLES);else if(O.isLine){let tn=G.linewidth;tn===void 0&&(tn=1),fe.setLineWidth(tn*Dn()),O.isLineSegments?yt.setMode(U.LINES):O.isLineLoop?yt.setMode(U.LINE_LOOP):yt.setMode(U.LINE_STRIP)}else O.isPoints?yt.setMode(U.POINTS):O.isSprite&&yt.setMode(U.TRIANGLES);if(O.isBatchedMesh)if(_t.get("WEBGL_multi_draw"))yt.renderMultiDraw(O._multiDrawStarts,O._multiDrawCounts,O._multiDrawCount);else{let tn=O._multiDrawStarts,Ee=O._multiDrawCounts,hn=O._multiDrawCount,it=xe?x.get(xe).bytesPerElement:1,hs=Fe.get(G).currentProgram.getUniforms();for(let nn=0;nn<hn;nn++)hs.setValue(U,"_gl_DrawID",nn),yt.render(tn[nn]/it,Ee[nn])}else if(O.isInstancedMesh)yt.renderInstances(_e,Bt,O.count);else if(k.isInstancedBufferGeometry){let tn=k._maxInstanceCount!==void 0?k._maxInstanceCount:1/0,Ee=Math.min(k.instanceCount,tn);yt.renderInstances(_e,Bt,Ee)}else yt.render(_e,Bt)};function Cp(v,B,k,G){D!==null&&v.isNodeMaterial&&D.setObject(G,v),Dt===!0&&Q.setState(v,k,!1),v.transparent===!0&&v.side===xn&&v.forceSinglePass===!1?(v.side=bn,v.needsUpdate=!0,Or(v,B,G),v.side=rs,v.needsUpdate=!0,Or(v,B,G),v.side=xn):Or(v,B,G)}this.compile=function(v,B,k=null){k===null&&(k=v),D!==null&&D.renderStart(v,B,k),R=J.get(k),R.init(B),E.push(R),k.traverseVisible(function(O){O.isLight&&O.layers.test(B.layers)&&(R.pushLight(O),O.castShadow&&R.pushShadow(O))}),v!==k&&v.traverseVisible(function(O){O.isLight&&O.layers.test(B.layers)&&(R.pushLight(O),O.castShadow&&R.pushShadow(O))}),R.setupLights(),D!==null&&D.updateLights(R.state.lightsArray),Sn=this.localClippingEnabled,Dt=Q.init(this.clippingPlanes,Sn),Dt===!0&&Q.setGlobalState(this.clippingPlanes,B),D!==null&&ce.render(R.state.shadowsArray,k,B);let G=new Set;return v.traverse(function(O){if(!(O.isMesh||O.isPoints||O.isLine||O.isSprite))return;let pe=O.material;if(pe)if(Array.isArray(pe))for(let ve=0;ve<pe.length;ve++){let de=pe[ve];Cp(de,k,B,O),G.add(de)}else Cp(pe,k,B,O),G.add(pe)}),R=E.pop(),D!==null&&D.renderEnd(),G},this.compileAsync=function(v,B,k=null){let G=this.compile(v,B,k);return new Promise(O=>{function pe(){if(G.forEach(function(ve){let xe=Fe.get(ve).currentProgram;(xe===void 0||xe.isReady())&&G.delete(ve)}),G.size===0){O(v);return}setTimeout(pe,10)}_t.get("KHR_parallel_shader_compile")!==null?pe():setTimeout(pe,10)})};let xu=null;function rx(v){xu&&xu(v)}function Ip(){ds.stop()}function Np(){ds.start()}let ds=new Lb;ds.setAnimationLoop(rx),typeof self<"u"&&ds.setContext(self),this.setAnimationLoop=function(v){xu=v,ie.setAnimationLoop(v),v===null?ds.stop():ds.start()},ie.addEventListener("sessionstart",Ip),ie.addEventListener("sessionend",Np),this.render=function(v,B){if(B!==void 0&&B.isCamera!==!0){Pe("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(P===!0)return;D!==null&&D.renderStart(v,B);let k=ie.enabled===!0&&ie.isPresenting===!0,G=L!==null&&(ne===null||k)&&L.begin(C,ne);if(v.matrixWorldAutoUpdate===!0&&v.updateMatrixWorld(),B.parent===null&&B.matrixWorldAutoUpdate===!0&&B.updateMatrixWorld(),ie.enabled===!0&&ie.isPresenting===!0&&(L===null||L.isCompositing()===!1)&&(ie.cameraAutoUpdate===!0&&ie.updateCamera(B),B=ie.getCamera()),v.isScene===!0&&v.onBeforeRender(C,v,B,ne),R=J.get(v,E.length),R.init(B),R.state.textureUnits=Ge.getTextureUnits(),E.push(R),Rt.multiplyMatrices(B.projectionMatrix,B.matrixWorldInverse),B.isArrayCamera?Kt.setFromArrayCamera(B):Qe.setFromProjectionMatrix(Rt,zn,B.reversedDepth),Sn=this.localClippingEnabled,Dt=Q.init(this.clippingPlanes,Sn),w=he.get(v,y.length),w.init(),y.push(w),this.info.render.frame++,ie.enabled===!0&&ie.isPresenting===!0){let ve=C.xr.getDepthSensingMesh();ve!==null&&vu(ve,B,-1/0,C.sortObjects)}vu(v,B,0,C.sortObjects),w.finish(),D!==null&&D.updateLights(R.state.lightsArray),C.sortObjects===!0&&w.sort(ze,Nt),Pn=ie.enabled===!1||ie.isPresenting===!1||ie.hasDepthSensing()===!1,Pn&&T.addToRenderList(w,v),this.info.autoReset===!0&&this.info.reset(),Dt===!0&&Q.beginShadows();let O=R.state.shadowsArray;if(ce.render(O,v,B),Dt===!0&&Q.endShadows(),(G&&L.hasRenderPass())===!1){let ve=w.opaque,de=w.transmissive;if(R.setupLights(),B.isArrayCamera){let xe=B.cameras;if(de.length>0)for(let Re=0,ke=xe.length;Re<ke;Re++){let Ke=xe[Re];Lp(ve,de,v,Ke)}Pn&&T.render(v);for(let Re=0,ke=xe.length;Re<ke;Re++){let Ke=xe[Re];Bp(w,v,Ke,Ke.viewport)}}else de.length>0&&Lp(ve,de,v,B),Pn&&T.render(v),Bp(w,v,B)}ne!==null&&z===0&&(Ge.updateMultisampleRenderTarget(ne),Ge.updateRenderTargetMipmap(ne)),G&&L.end(C),v.isScene===!0&&v.onAfterRender(C,v,B),le.resetDefaultState(),H=-1,$=null,E.pop(),E.length>0?(R=E[E.length-1],Ge.setTextureUnits(R.state.textureUnits),Dt===!0&&Q.setGlobalState(C.clippingPlanes,R.state.camera)):R=null,y.pop(),y.length>0?w=y[y.length-1]:w=null,D!==null&&D.renderEnd()};function vu(v,B,k,G){if(v.visible===!1)return;if(v.layers.test(B.layers)){if(v.isGroup)k=v.renderOrder;else if(v.isLOD)v.autoUpdate===!0&&v.update(B);else if(v.isLight)R.pushLight(v),v.castShadow&&R.pushShadow(v);else if(v.isSprite){let ve=B.isArrayCamera?Kt:Qe;if(!v.frustumCulled||v.intersectsFrustum(ve)){G&&Xt.setFromMatrixPosition(v.matrixWorld).applyMatrix4(Rt);let de=te.update(v),xe=v.material;xe.visible&&w.push(v,de,xe,k,Xt.z,null,B)}}else if(v.isMesh||v.isLine||v.isPoints){let ve=B.isArrayCamera?Kt:Qe;if(!v.frustumCulled||v.intersectsFrustum(ve)){let de=te.update(v),xe=v.material;if(G&&(v.boundingSphere!==void 0?(v.boundingSphere===null&&v.computeBoundingSphere(),Xt.copy(v.boundingSphere.center)):(de.boundingSphere===null&&de.computeBoundingSphere(),Xt.copy(de.boundingSphere.center)),Xt.applyMatrix4(v.matrixWorld).applyMatrix4(Rt)),Array.isArray(xe)){let Re=de.groups;for(let ke=0,Ke=Re.length;ke<Ke;ke++){let _e=Re[ke],qe=xe[_e.materialIndex];qe&&qe.visible&&w.push(v,de,qe,k,Xt.z,_e,B)}}else xe.visible&&w.push(v,de,xe,k,Xt.z,null,B)}}}let pe=v.children;for(let ve=0,de=pe.length;ve<de;ve++)vu(pe[ve],B,k,G)}function Bp(v,B,k,G){let{opaque:O,transmissive:pe,transparent:ve}=v;R.setupLightsView(k),Dt===!0&&Q.setGlobalState(C.clippingPlanes,k),G&&fe.viewport(ee.copy(G)),O.length>0&&ma(O,B,k),pe.length>0&&ma(pe,B,k),ve.length>0&&ma(ve,B,k),fe.buffers.depth.setTest(!0),fe.buffers.depth.setMask(!0),fe.buffers.color.setMask(!0),fe.setPolygonOffset(!1)}function Lp(v,B,k,G){if((k.isScene===!0?k.overrideMaterial:null)!==null)return;if(R.state.transmissionRenderTarget[G.id]===void 0){let _e=_t.has("EXT_color_buffer_half_float")||_t.has("EXT_color_buffer_float");R.state.transmissionRenderTarget[G.id]=new Bn(1,1,{generateMipmaps:!0,type:_e?ui:Mn,minFilter:Gi,samples:Math.max(4,Et.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:je.workingColorSpace})}let pe=R.state.transmissionRenderTarget[G.id],ve=G.viewport||ee;pe.setSize(ve.z*C.transmissionResolutionScale,ve.w*C.transmissionResolutionScale);let de=C.getRenderTarget(),xe=C.getActiveCubeFace(),Re=C.getActiveMipmapLevel();C.setRenderTarget(pe),C.getClearColor(K),ye=C.getClearAlpha(),ye<1&&C.setClearColor(16777215,.5),C.clear(),Pn&&T.render(k);let ke=C.toneMapping;C.toneMapping=xi;let Ke=G.viewport;if(G.viewport!==void 0&&(G.viewport=void 0),R.setupLightsView(G),Dt===!0&&Q.setGlobalState(C.clippingPlanes,G),ma(v,k,G),Ge.updateMultisampleRenderTarget(pe),Ge.updateRenderTargetMipmap(pe),_t.has("WEBGL_multisampled_render_to_texture")===!1){let _e=!1;for(let qe=0,Bt=B.length;qe<Bt;qe++){let bt=B[qe],{object:yt,geometry:tn,material:Ee,group:hn}=bt;if(Ee.side===xn&&yt.layers.test(G.layers)){let it=Ee.side;Ee.side=bn,Ee.needsUpdate=!0,Fp(yt,k,G,tn,Ee,hn),Ee.side=it,Ee.needsUpdate=!0,_e=!0}}_e===!0&&(Ge.updateMultisampleRenderTarget(pe),Ge.updateRenderTargetMipmap(pe))}C.setRenderTarget(de,xe,Re),C.setClearColor(K,ye),Ke!==void 0&&(G.viewport=Ke),C.toneMapping=ke}function ma(v,B,k){let G=B.isScene===!0?B.overrideMaterial:null;for(let O=0,pe=v.length;O<pe;O++){let ve=v[O],{object:de,geometry:xe,group:Re}=ve,ke=ve.material;ke.allowOverride===!0&&G!==null&&(ke=G),de.layers.test(k.layers)&&Fp(de,B,k,xe,ke,Re)}}function Fp(v,B,k,G,O,pe){D!==null&&O.isNodeMaterial&&D.setObject(v,O),v.onBeforeRender(C,B,k,G,O,pe),v.modelViewMatrix.multiplyMatrices(k.matrixWorldInverse,v.matrixWorld),v.normalMatrix.getNormalMatrix(v.modelViewMatrix),O.onBeforeRender(C,B,k,G,v,pe),O.transparent===!0&&O.side===xn&&O.forceSinglePass===!1?(O.side=bn,O.needsUpdate=!0,C.renderBufferDirect(k,B,G,O,v,pe),O.side=rs,O.needsUpdate=!0,C.renderBufferDirect(k,B,G,O,v,pe),O.side=xn):C.renderBufferDirect(k,B,G,O,v,pe),v.onAfterRender(C,B,k,G,O,pe)}function Up(v){let B=0;for(let k of v)k.texture!==null&&B++;return B}function Or(v,B,k){B.isScene!==!0&&(B=Un);let G=Fe.get(v),O=R.state.lights,pe=R.state.shadowsArray,ve=O.state.version,de=j.getParameters(v,O.state,pe,B,k,R.state.lightProbeGridArray),xe=j.getProgramCacheKey(de),Re=G.programs;G.environment=v.isMeshStandardMaterial||v.isMeshLambertMaterial||v.isMeshPhongMaterial?B.environment:null,G.fog=B.fog;let ke=v.isMeshStandardMaterial||v.isMeshLambertMaterial&&!v.envMap||v.isMeshPhongMaterial&&!v.envMap;G.envMap=M.get(v.envMap||G.environment,ke),G.envMapRotation=G.environment!==null&&v.envMap===null?B.environmentRotation:v.envMapRotation,Re===void 0&&(v.addEventListener("dispose",ht),Re=new Map,G.programs=Re,G.programVariants=new Map);let Ke=Re.get(xe);if(Ke!==void 0){if(G.currentProgram===Ke&&G.lightsStateVersion===ve)return Dp(v,de),Ke}else de.uniforms=j.getUniforms(v),D!==null&&v.isNodeMaterial&&D.build(v,k,de),v.onBeforeCompile(de,C),Ke=j.acquireProgram(de,xe),Re.set(xe,Ke),G.uniforms=de.uniforms;let _e=G.uniforms;return(!v.isShaderMaterial&&!v.isRawShaderMaterial||v.clipping===!0)&&(_e.clippingPlanes=Q.uniform),Dp(v,de),G.needsLights=cx(v),G.lightsStateVersion=ve,G.needsLights&&(_e.ambientLightColor.value=O.state.ambient,_e.lightProbe.value=O.state.probe,_e.sunLights.value=O.state.sun,_e.sunLightShadows.value=O.state.sunShadow,_e.directionalLights.value=O.state.directional,_e.directionalLightShadows.value=O.state.directionalShadow,_e.spotLights.value=O.state.spot,_e.spotLightShadows.value=O.state.spotShadow,_e.rectAreaLights.value=O.state.rectArea,_e.ltc_1.value=O.state.rectAreaLTC1,_e.ltc_2.value=O.state.rectAreaLTC2,_e.pointLights.value=O.state.point,_e.pointLightShadows.value=O.state.pointShadow,_e.hemisphereLights.value=O.state.hemi,_e.sunShadowMatrix.value=O.state.sunShadowMatrix,_e.sunShadowCascade.value=O.state.sunShadowCascade,_e.directionalShadowMatrix.value=O.state.directionalShadowMatrix,_e.spotLightMatrix.value=O.state.spotLightMatrix,_e.spotLightMap.value=O.state.spotLightMap,_e.pointShadowMatrix.value=O.state.pointShadowMatrix),G.numLightProbeGrids=Up(R.state.lightProbeGridArray),G.currentProgram=Ke,G.uniformsList=null,Ke}function ox(v,B,k,G,O){let pe=Fe.get(v),ve=pe.currentProgram.id+","+G+","+O,de=pe.programVariants.get(ve);return de===void 0?(de=Or(v,B,k),pe.programVariants.set(ve,de)):(pe.currentProgram=de,pe.uniformsList=null,pe.outputColorSpace=G,pe.toneMapping=O),de}function Pp(v){if(v.uniformsList===null){let B=v.currentProgram.getUniforms();v.uniformsList=Cr.seqWithValue(B.seq,v.uniforms)}return v.uniformsList}function Dp(v,B){let k=Fe.get(v);k.outputColorSpace=B.outputColorSpace,k.batching=B.batching,k.batchingColor=B.batchingColor,k.instancing=B.instancing,k.instancingColor=B.instancingColor,k.instancingMorph=B.instancingMorph,k.skinning=B.skinning,k.morphTargets=B.morphTargets,k.morphNormals=B.morphNormals,k.morphColors=B.morphColors,k.morphTargetsCount=B.morphTargetsCount,k.numClippingPlanes=B.numClippingPlanes,k.numIntersection=B.numClipIntersection,k.vertexAlphas=B.vertexAlphas,k.vertexTangents=B.vertexTangents,k.toneMapping=B.toneMapping}function ax(v,B,k,G,O){B.isScene!==!0&&(B=Un),Ge.resetTextureUnits();let pe=B.fog,ve=G.isMeshStandardMaterial||G.isMeshLambertMaterial||G.isMeshPhongMaterial?B.environment:null,de=ne===null?C.outputColorSpace:ne.isXRRenderTarget===!0?ne.texture.colorSpace:je.workingColorSpace,xe=G.isMeshStandardMaterial||G.isMeshLambertMaterial&&!G.envMap||G.isMeshPhongMaterial&&!G.envMap,Re=M.get(G.envMap||ve,xe),ke=G.vertexColors===!0&&!!k.attributes.color&&k.attributes.color.itemSize===4,Ke=!!k.attributes.tangent&&(!!G.normalMap||G.anisotropy>0),_e=!!k.morphAttributes.position,qe=!!k.morphAttributes.normal,Bt=!!k.morphAttributes.color,bt=xi;G.toneMapped&&(ne===null||ne.isXRRenderTarget===!0)&&(bt=C.toneMapping);let yt=k.morphAttributes.position||k.morphAttributes.normal||k.morphAttributes.color,tn=yt!==void 0?yt.length:0,Ee=Fe.get(G),hn=R.state.lights;if(Dt===!0&&(Sn===!0||v!==$)){let wt=v===$&&G.id===H;Q.setState(G,v,wt)}let it=!1,hs=!1;G.version===Ee.__version?Ee.needsLights&&Ee.lightsStateVersion!==hn.state.version||O.isBatchedMesh&&Ee.batching===!1||!O.isBatchedMesh&&Ee.batching===!0||O.isBatchedMesh&&Ee.batchingColor===!0&&O._colorsTexture===null||O.isBatchedMesh&&Ee.batchingColor===!1&&O._colorsTexture!==null||O.isInstancedMesh&&Ee.instancing===!1||!O.isInstancedMesh&&Ee.instancing===!0||O.isSkinnedMesh&&Ee.skinning===!1||!O.isSkinnedMesh&&Ee.skinning===!0||O.isInstancedMesh&&Ee.instancingColor===!0&&O.instanceColor===null||O.isInstancedMesh&&Ee.instancingColor===!1&&O.instanceColor!==null||O.isInstancedMesh&&Ee.instancingMorph===!0&&O.morphTexture===null||O.isInstancedMesh&&Ee.instancingMorph===!1&&O.morphTexture!==null||Ee.envMap!==Re||G.fog===!0&&Ee.fog!==pe||Ee.numClippingPlanes!==void 0&&(Ee.numClippingPlanes!==Q.numPlanes||Ee.numIntersection!==Q.numIntersection)||Ee.vertexAlphas!==ke||Ee.vertexTangents!==Ke||Ee.morphTargets!==_e||Ee.morphNormals!==qe||Ee.morphColors!==Bt||Ee.morphTargetsCount!==tn||Ee.numLightProbeGrids!==Up(R.state.lightProbeGridArray)?it=!0:(Ee.outputColorSpace!==de||Ee.toneMapping!==bt)&&(hs=!0):(it=!0,Ee.__version=G.version);let nn=Ee.currentProgram;(it===!0||hs===!0)&&(nn=hs===!0?ox(G,B,O,de,bt):Or(G,B,O),D&&G.isNodeMaterial&&D.onUpdateProgram(G,nn,Ee));let ga=!1,Xi=!1,ps=!1,tt=nn.getUniforms(),qt=Ee.uniforms;if(fe.useProgram(nn.program)&&(ga=!0,Xi=!0,ps=!0),G.id!==H&&(H=G.id,Xi=!0),ga||$!==v){fe.buffers.depth.getReversed()&&v.reversedDepth!==!0&&(v._reversedDepth=!0,v.updateProjectionMatrix()),tt.setValue(U,"projectionMatrix",v.projectionMatrix),tt.setValue(U,"viewMatrix",v.matrixWorldInverse);let Ht=tt.map.cameraPosition;Ht!==void 0&&Ht.setValue(U,di.setFromMatrixPosition(v.matrixWorld)),Et.logarithmicDepthBuffer&&tt.setValue(U,"logDepthBufFC",2/(Math.log(v.far+1)/Math.LN2)),(G.isMeshPhongMaterial||G.isMeshToonMaterial||G.isMeshLambertMaterial||G.isMeshBasicMaterial||G.isMeshStandardMaterial||G.isShaderMaterial)&&tt.setValue(U,"isOrthographic",v.isOrthographicCamera===!0),$!==v&&($=v,Xi=!0,ps=!0)}if(Ee.needsLights&&(hn.state.sunShadowMap.length>0&&tt.setValue(U,"sunShadowMap",hn.state.sunShadowMap,Ge),hn.state.directionalShadowMap.length>0&&tt.setValue(U,"directionalShadowMap",hn.state.directionalShadowMap,Ge),hn.state.spotShadowMap.length>0&&tt.setValue(U,"spotShadowMap",hn.state.spotShadowMap,Ge),hn.state.pointShadowMap.length>0&&tt.setValue(U,"pointShadowMap",hn.state.pointShadowMap,Ge)),O.isSkinnedMesh){tt.setOptional(U,O,"bindMatrix"),tt.setOptional(U,O,"bindMatrixInverse");let wt=O.skeleton;wt&&(wt.boneTexture===null&&wt.computeBoneTexture(),tt.setValue(U,"boneTexture",wt.boneTexture,Ge))}O.isBatchedMesh&&(tt.setOptional(U,O,"batchingTexture"),tt.setValue(U,"batchingTexture",O._matricesTexture,Ge),tt.setOptional(U,O,"batchingIdTexture"),tt.setValue(U,"batchingIdTexture",O._indirectTexture,Ge),tt.setOptional(U,O,"batchingColorTexture"),O._colorsTexture!==null&&tt.setValue(U,"batchingColorTexture",O._colorsTexture,Ge));let Kn=k.morphAttributes;if((Kn.position!==void 0||Kn.normal!==void 0||Kn.color!==void 0)&&q.update(O,k,nn),(Xi||Ee.receiveShadow!==O.receiveShadow)&&(Ee.receiveShadow=O.receiveShadow,tt.setValue(U,"receiveShadow",O.receiveShadow)),(G.isMeshStandardMaterial||G.isMeshLambertMaterial||G.isMeshPhongMaterial)&&G.envMap===null&&B.environment!==null&&(qt.envMapIntensity.value=B.environmentIntensity),qt.dfgLUT!==void 0&&(qt.dfgLUT.value=Tw()),Xi){if(tt.setValue(U,"toneMappingExposure",C.toneMappingExposure),Ee.needsLights&&lx(qt,ps),pe&&G.fog===!0&&ae.refreshFogUniforms(qt,pe),ae.refreshMaterialUniforms(qt,G,be,Le,R.state.transmissionRenderTarget[v.id]),Ee.needsLights&&Ee.numLightProbeGrids>0){let wt=_,Ht=0;for(let Ei of R.state.lightProbeGridArray)Ei.texture!==null&&(wt.textures[Ht]=Ei.texture,wt.min[Ht]=Ei.boundingBox.min,wt.max[Ht]=Ei.boundingBox.max,wt.resolution[Ht]=Ei.resolution,Ht++);for(let Ei in wt)wt[Ei].length=Ht;qt.probesSH.value=wt.textures,qt.probesMin.value=wt.min,qt.probesMax.value=wt.max,qt.probesResolution.value=wt.resolution}Cr.upload(U,Pp(Ee),qt,Ge)}if(G.isShaderMaterial&&G.uniformsNeedUpdate===!0&&(Cr.upload(U,Pp(Ee),qt,Ge),G.uniformsNeedUpdate=!1),G.isSpriteMaterial&&tt.setValue(U,"center",O.center),tt.setValue(U,"modelViewMatrix",O.modelViewMatrix),tt.setValue(U,"normalMatrix",O.normalMatrix),tt.setValue(U,"modelMatrix",O.matrixWorld),G.uniformsGroups!==void 0){let wt=G.uniformsGroups;for(let Ht=0,Ei=wt.length;Ht<Ei;Ht++){let Vp=wt[Ht];we.update(Vp,nn),we.bind(Vp,nn)}}return nn}function lx(v,B){v.ambientLightColor.needsUpdate=B,v.lightProbe.needsUpdate=B,v.sunLights.needsUpdate=B,v.sunLightShadows.needsUpdate=B,v.directionalLights.needsUpdate=B,v.directionalLightShadows.needsUpdate=B,v.pointLights.needsUpdate=B,v.pointLightShadows.needsUpdate=B,v.spotLights.needsUpdate=B,v.spotLightShadows.needsUpdate=B,v.rectAreaLights.needsUpdate=B,v.hemisphereLights.needsUpdate=B}function cx(v){return v.isMeshLambertMaterial||v.isMeshToonMaterial||v.isMeshPhongMaterial||v.isMeshStandardMaterial||v.isShadowMaterial||v.isShaderMaterial&&v.lights===!0}this.getActiveCubeFace=function(){return Y},this.getActiveMipmapLevel=function(){return z},this.getRenderTarget=function(){return ne},this.setRenderTargetTextures=function(v,B,k){let G=Fe.get(v);G.__autoAllocateDepthBuffer=v.resolveDepthBuffer===!1,G.__autoAllocateDepthBuffer===!1&&(G.__useRenderToTexture=!1),Fe.get(v.texture).__webglTexture=B,Fe.get(v.depthTexture).__webglTexture=G.__autoAllocateDepthBuffer?void 0:k,G.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(v,B){let k=Fe.get(v);k.__webglFramebuffer=B,k.__useDefaultFramebuffer=B===void 0},this.setRenderTarget=function(v,B=0,k=0){ne=v,Y=B,z=k;let G=null,O=!1,pe=!1;if(v){let de=Fe.get(v);if(de.__useDefaultFramebuffer!==void 0){fe.bindFramebuffer(U.FRAMEBUFFER,de.__webglFramebuffer),ee.copy(v.viewport),Me.copy(v.scissor),Oe=v.scissorTest,fe.viewport(ee),fe.scissor(Me),fe.setScissorTest(Oe),H=-1;return}else if(de.__webglFramebuffer===void 0)Ge.setupRenderTarget(v);else if(de.__hasExternalTextures)Ge.rebindTextures(v,Fe.get(v.texture).__webglTexture,Fe.get(v.depthTexture).__webglTexture);else if(v.depthBuffer){let ke=v.depthTexture;if(de.__boundDepthTexture!==ke){if(ke!==null&&Fe.has(ke)&&(v.width!==ke.image.width||v.height!==ke.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");Ge.setupDepthRenderbuffer(v)}}let xe=v.texture;(xe.isData3DTexture||xe.isDataArrayTexture||xe.isCompressedArrayTexture)&&(pe=!0);let Re=Fe.get(v).__webglFramebuffer;v.isWebGLCubeRenderTarget?(Array.isArray(Re[B])?G=Re[B][k]:G=Re[B],O=!0):v.samples>0&&Ge.useMultisampledRTT(v)===!1?G=Fe.get(v).__webglMultisampledFramebuffer:Array.isArray(Re)?G=Re[k]:G=Re,ee.copy(v.viewport),Me.copy(v.scissor),Oe=v.scissorTest}else ee.copy(Ue).multiplyScalar(be).floor(),Me.copy(dt).multiplyScalar(be).floor(),Oe=gt;if(k!==0&&(G=W),fe.bindFramebuffer(U.FRAMEBUFFER,G)&&fe.drawBuffers(v,G),fe.viewport(ee),fe.scissor(Me),fe.setScissorTest(Oe),O){let de=Fe.get(v.texture);U.framebufferTexture2D(U.FRAMEBUFFER,U.COLOR_ATTACHMENT0,U.TEXTURE_CUBE_MAP_POSITIVE_X+B,de.__webglTexture,k)}else if(pe){let de=B;for(let xe=0;xe<v.textures.length;xe++){let Re=Fe.get(v.textures[xe]);U.framebufferTextureLayer(U.FRAMEBUFFER,U.COLOR_ATTACHMENT0+xe,Re.__webglTexture,k,de)}}else if(v!==null&&k!==0){let de=Fe.get(v.texture);U.framebufferTexture2D(U.FRAMEBUFFER,U.COLOR_ATTACHMENT0,U.TEXTURE_2D,de.__webglTexture,k)}H=-1};function Gp(v){let B=Fe.get(v);return(B.__readFormat!==v.format||B.__readType!==v.type)&&(B.__readFormat=v.format,B.__readType=v.type,B.__formatReadable=Et.textureFormatReadable(v.format),B.__typeReadable=Et.textureTypeReadable(v.type)),B}this.readRenderTargetPixels=function(v,B,k,G,O,pe,ve,de=0){if(!(v&&v.isWebGLRenderTarget)){Pe("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let xe=Fe.get(v).__webglFramebuffer;if(v.isWebGLCubeRenderTarget&&ve!==void 0&&(xe=xe[ve],Array.isArray(xe)&&(xe=xe[0])),xe){fe.bindFramebuffer(U.FRAMEBUFFER,xe);try{let Re=v.textures[de],ke=Re.format,Ke=Re.type;v.textures.length>1&&U.readBuffer(U.COLOR_ATTACHMENT0+de);let _e=Gp(Re);if(_e.__formatReadable===!1){Pe("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(_e.__typeReadable===!1){Pe("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}B>=0&&B<=v.width-G&&k>=0&&k<=v.height-O&&U.readPixels(B,k,G,O,oe.convert(ke),oe.convert(Ke),pe)}finally{let Re=ne!==null?Fe.get(ne).__webglFramebuffer:null;fe.bindFramebuffer(U.FRAMEBUFFER,Re)}}},this.readRenderTargetPixelsAsync=async function(v,B,k,G,O,pe,ve,de=0){if(!(v&&v.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let xe=Fe.get(v).__webglFramebuffer;if(v.isWebGLCubeRenderTarget&&ve!==void 0&&(xe=xe[ve],Array.isArray(xe)&&(xe=xe[0])),xe)if(B>=0&&B<=v.width-G&&k>=0&&k<=v.height-O){fe.bindFramebuffer(U.FRAMEBUFFER,xe);let Re=v.textures[de],ke=Re.format,Ke=Re.type;v.textures.length>1&&U.readBuffer(U.COLOR_ATTACHMENT0+de);let _e=Gp(Re);if(_e.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(_e.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let qe=U.createBuffer();U.bindBuffer(U.PIXEL_PACK_BUFFER,qe),U.bufferData(U.PIXEL_PACK_BUFFER,pe.byteLength,U.STREAM_READ),U.readPixels(B,k,G,O,oe.convert(ke),oe.convert(Ke),0),U.bindBuffer(U.PIXEL_PACK_BUFFER,null);let Bt=ne!==null?Fe.get(ne).__webglFramebuffer:null;fe.bindFramebuffer(U.FRAMEBUFFER,Bt);let bt=U.fenceSync(U.SYNC_GPU_COMMANDS_COMPLETE,0);return U.flush(),await sb(U,bt,4),U.bindBuffer(U.PIXEL_PACK_BUFFER,qe),U.getBufferSubData(U.PIXEL_PACK_BUFFER,0,pe),U.bindBuffer(U.PIXEL_PACK_BUFFER,null),U.deleteBuffer(qe),U.deleteSync(bt),pe}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(v,B=null,k=0){let G=Math.pow(2,-k),O=Math.floor(v.image.width*G),pe=Math.floor(v.image.height*G),ve=B!==null?B.x:0,de=B!==null?B.y:0;Ge.setTexture2D(v,0),U.copyTexSubImage2D(U.TEXTURE_2D,k,0,0,ve,de,O,pe),fe.unbindTexture()},this.copyTextureToTexture=function(v,B,k=null,G=null,O=0,pe=0){let ve,de,xe,Re,ke,Ke,_e,qe,Bt,bt=v.isCompressedTexture?v.mipmaps[pe]:v.image;if(k!==null)ve=k.max.x-k.min.x,de=k.max.y-k.min.y,xe=k.isBox3?k.max.z-k.min.z:1,Re=k.min.x,ke=k.min.y,Ke=k.isBox3?k.min.z:0;else{let tt=Math.pow(2,-O);ve=Math.floor(bt.width*tt),de=Math.floor(bt.height*tt),v.isDataArrayTexture?xe=bt.depth:v.isData3DTexture?xe=Math.floor(bt.depth*tt):xe=1,Re=0,ke=0,Ke=0}G!==null?(_e=G.x,qe=G.y,Bt=G.z):(_e=0,qe=0,Bt=0);let yt=oe.convert(B.format),tn=oe.convert(B.type),Ee;B.isData3DTexture?(Ge.setTexture3D(B,0),Ee=U.TEXTURE_3D):B.isDataArrayTexture||B.isCompressedArrayTexture?(Ge.setTexture2DArray(B,0),Ee=U.TEXTURE_2D_ARRAY):(Ge.setTexture2D(B,0),Ee=U.TEXTURE_2D),fe.activeTexture(U.TEXTURE0),fe.pixelStorei(U.UNPACK_FLIP_Y_WEBGL,B.flipY),fe.pixelStorei(U.UNPACK_PREMULTIPLY_ALPHA_WEBGL,B.premultiplyAlpha),fe.pixelStorei(U.UNPACK_ALIGNMENT,B.unpackAlignment);let hn=fe.getParameter(U.UNPACK_ROW_LENGTH),it=fe.getParameter(U.UNPACK_IMAGE_HEIGHT),hs=fe.getParameter(U.UNPACK_SKIP_PIXELS),nn=fe.getParameter(U.UNPACK_SKIP_ROWS),ga=fe.getParameter(U.UNPACK_SKIP_IMAGES);fe.pixelStorei(U.UNPACK_ROW_LENGTH,bt.width),fe.pixelStorei(U.UNPACK_IMAGE_HEIGHT,bt.height),fe.pixelStorei(U.UNPACK_SKIP_PIXELS,Re),fe.pixelStorei(U.UNPACK_SKIP_ROWS,ke),fe.pixelStorei(U.UNPACK_SKIP_IMAGES,Ke);let Xi=v.isDataArrayTexture||v.isData3DTexture,ps=B.isDataArrayTexture||B.isData3DTexture;if(v.isDepthTexture){let tt=Fe.get(v),qt=Fe.get(B),Kn=Fe.get(tt.__renderTarget),wt=Fe.get(qt.__renderTarget);fe.bindFramebuffer(U.READ_FRAMEBUFFER,Kn.__webglFramebuffer),fe.bindFramebuffer(U.DRAW_FRAMEBUFFER,wt.__webglFramebuffer);for(let Ht=0;Ht<xe;Ht++)Xi&&(U.framebufferTextureLayer(U.READ_FRAMEBUFFER,U.COLOR_ATTACHMENT0,Fe.get(v).__webglTexture,O,Ke+Ht),U.framebufferTextureLayer(U.DRAW_FRAMEBUFFER,U.COLOR_ATTACHMENT0,Fe.get(B).__webglTexture,pe,Bt+Ht)),U.blitFramebuffer(Re,ke,Re+ve,ke+de,_e,qe,_e+ve,qe+de,U.DEPTH_BUFFER_BIT,U.NEAREST);fe.bindFramebuffer(U.READ_FRAMEBUFFER,null),fe.bindFramebuffer(U.DRAW_FRAMEBUFFER,null)}else if(O!==0||v.isRenderTargetTexture||Fe.has(v)){let tt=Fe.get(v),qt=Fe.get(B);fe.bindFramebuffer(U.READ_FRAMEBUFFER,I),fe.bindFramebuffer(U.DRAW_FRAMEBUFFER,X);for(let Kn=0;Kn<xe;Kn++)Xi?U.framebufferTextureLayer(U.READ_FRAMEBUFFER,U.COLOR_ATTACHMENT0,tt.__webglTexture,O,Ke+Kn):U.framebufferTexture2D(U.READ_FRAMEBUFFER,U.COLOR_ATTACHMENT0,U.TEXTURE_2D,tt.__webglTexture,O),ps?U.framebufferTextureLayer(U.DRAW_FRAMEBUFFER,U.COLOR_ATTACHMENT0,qt.__webglTexture,pe,Bt+Kn):U.framebufferTexture2D(U.DRAW_FRAMEBUFFER,U.COLOR_ATTACHMENT0,U.TEXTURE_2D,qt.__webglTexture,pe),O!==0?U.blitFramebuffer(Re,ke,Re+ve,ke+de,_e,qe,_e+ve,qe+de,U.COLOR_BUFFER_BIT,U.NEAREST):ps?U.copyTexSubImage3D(Ee,pe,_e,qe,Bt+Kn,Re,ke,ve,de):U.copyTexSubImage2D(Ee,pe,_e,qe,Re,ke,ve,de);fe.bindFramebuffer(U.READ_FRAMEBUFFER,null),fe.bindFramebuffer(U.DRAW_FRAMEBUFFER,null)}else ps?v.isDataTexture||v.isData3DTexture?U.texSubImage3D(Ee,pe,_e,qe,Bt,ve,de,xe,yt,tn,bt.data):B.isCompressedArrayTexture?U.compressedTexSubImage3D(Ee,pe,_e,qe,Bt,ve,de,xe,yt,bt.data):U.texSubImage3D(Ee,pe,_e,qe,Bt,ve,de,xe,yt,tn,bt):v.isDataTexture?U.texSubImage2D(U.TEXTURE_2D,pe,_e,qe,ve,de,yt,tn,bt.data):v.isCompressedTexture?U.compressedTexSubImage2D(U.TEXTURE_2D,pe,_e,qe,bt.width,bt.height,yt,bt.data):U.texSubImage2D(U.TEXTURE_2D,pe,_e,qe,ve,de,yt,tn,bt);fe.pixelStorei(U.UNPACK_ROW_LENGTH,hn),fe.pixelStorei(U.UNPACK_IMAGE_HEIGHT,it),fe.pixelStorei(U.UNPACK_SKIP_PIXELS,hs),fe.pixelStorei(U.UNPACK_SKIP_ROWS,nn),fe.pixelStorei(U.UNPACK_SKIP_IMAGES,ga),pe===0&&B.generateMipmaps===!0&&B.mipmapsAutoUpdate===!0&&U.generateMipmap(Ee),fe.unbindTexture()},this.initRenderTarget=function(v){Fe.get(v).__webglFramebuffer===void 0&&Ge.setupRenderTarget(v)},this.initTexture=function(v){v.isCubeTexture?Ge.setTextureCube(v,0):v.isData3DTexture?Ge.setTexture3D(v,0):v.isDataArrayTexture||v.isCompressedArrayTexture?Ge.setTexture2DArray(v,0):Ge.setTexture2D(v,0),fe.unbindTexture()},this.resetState=function(){Y=0,z=0,ne=null,fe.reset(),le.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return zn}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(e){this._outputColorSpace=e;let t=this.getContext();t.drawingBufferColorSpace=je._getDrawingBufferColorSpace(e),t.unpackColorSpace=je._getUnpackColorSpace()}};var Cw=2e3,Xb=6,Iw=11050893;function Nw(n){switch(n.shape.case){case"sphere":return new es(n.shape.value.radiusM,32,20);case"capsule":return new Fo(n.shape.value.radiusM,2*n.shape.value.halfLengthM,12,24).rotateX(Math.PI/2);case"box":{let e=n.shape.value.halfM;return new ai(2*(e?.x??0),2*(e?.y??0),2*(e?.z??0))}default:return new Pi(Xb,Xb)}}var Nr=class{group=new Nn;meshes=new Map;material=new Do({color:Iw,roughness:.8,side:xn});pose=new Float32Array(At);known="";asked=-1/0;asking=!1;async follow(e,t,i){let s=i.obstacles.length?`${t} ${i.obstacles.map(o=>o.obstacleId).join(" ")}`:"",r=s&&performance.now()-this.asked>Cw;if(!(this.asking||s===this.known&&!r)){this.asking=!0;try{let{obstacles:o}=s?await e.obstacles.listObstacles({parent:t,pageSize:1e3}):{obstacles:[]};this.known=s,this.asked=performance.now(),this.show(o)}catch{}finally{this.asking=!1}}}show(e){for(let t of this.meshes.values())t.geometry.dispose();this.group.clear(),this.meshes.clear();for(let t of e){let i=new Mt(Nw(t),this.material);i.castShadow=t.shape.case!=="plane",i.receiveShadow=!0,this.meshes.set(t.name.split("/").at(-1)??"",i),this.group.add(i)}}place(e,t,i){let s=new Map(e.obstacles.map(o=>[o.obstacleId,o])),r=new Set;for(let o of t.obstacles){let a=this.meshes.get(o.obstacleId),l=Tt(o.pose);!a||l.length!==At||(oo(Tt(s.get(o.obstacleId)?.pose),l,i,this.pose),a.position.fromArray(this.pose),a.quaternion.fromArray(this.pose,3),r.add(a))}for(let o of this.meshes.values())o.visible=r.has(o)}};var Zb={type:"change"},Kh={type:"start"},Yb={type:"end"},qc=new oi,Hb=new fn,Bw=Math.cos(70*ki.DEG2RAD),zt=new F,Rn=2*Math.PI,st={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},Qh=1e-6,jc=class extends Zo{constructor(e,t=null){super(e,t),this.state=st.NONE,this.target=new F,this.cursor=new F,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.keyRotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:ss.ROTATE,MIDDLE:ss.DOLLY,RIGHT:ss.PAN},this.touches={ONE:li.ROTATE,TWO:li.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._cursorStyle="auto",this._domElementKeyEvents=null,this._lastPosition=new F,this._lastQuaternion=new en,this._lastTargetPosition=new F,this._quat=new en().setFromUnitVectors(e.up,new F(0,1,0)),this._quatInverse=this._quat.clone().invert(),this._spherical=new Ar,this._sphericalDelta=new Ar,this._scale=1,this._panOffset=new F,this._rotateStart=new Be,this._rotateEnd=new Be,this._rotateDelta=new Be,this._panStart=new Be,this._panEnd=new Be,this._panDelta=new Be,this._dollyStart=new Be,this._dollyEnd=new Be,this._dollyDelta=new Be,this._dollyDirection=new F,this._mouse=new Be,this._performCursorZoom=!1,this._pointers=[],this._pointerPositions={},this._controlActive=!1,this._onPointerMove=Fw.bind(this),this._onPointerDown=Lw.bind(this),this._onPointerUp=Uw.bind(this),this._onContextMenu=Ww.bind(this),this._onMouseWheel=Gw.bind(this),this._onKeyDown=Vw.bind(this),this._onTouchStart=Ow.bind(this),this._onTouchMove=kw.bind(this),this._onMouseDown=Pw.bind(this),this._onMouseMove=Dw.bind(this),this._interceptControlDown=zw.bind(this),this._interceptControlUp=Xw.bind(this),this.domElement!==null&&this.connect(this.domElement),this.update()}set cursorStyle(e){this._cursorStyle=e,e==="grab"?this.domElement.style.cursor="grab":this.domElement.style.cursor="auto"}get cursorStyle(){return this._cursorStyle}connect(e){super.connect(e),this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointercancel",this._onPointerUp),this.domElement.addEventListener("contextmenu",this._onContextMenu),this.domElement.addEventListener("wheel",this._onMouseWheel,{passive:!1}),this.domElement.ownerDocument.addEventListener("keydown",this._interceptControlDown,{passive:!0,capture:!0}),this.domElement.style.touchAction="none"}disconnect(){this.state=st.NONE,this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.domElement.removeEventListener("pointercancel",this._onPointerUp),this.domElement.removeEventListener("wheel",this._onMouseWheel),this.domElement.removeEventListener("contextmenu",this._onContextMenu),this.stopListenToKeyEvents(),this.domElement.ownerDocument.removeEventListener("keydown",this._interceptControlDown,{capture:!0}),this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{capture:!0}),this._controlActive=!1,this._pointers.length=0,this._pointerPositions={},this.domElement.style.touchAction="",this.domElement.style.cursor="auto"}dispose(){this.disconnect()}getPolarAngle(){return this._spherical.phi}getAzimuthalAngle(){return this._spherical.theta}getDistance(){return this.object.position.distanceTo(this.target)}listenToKeyEvents(e){e.addEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=e}stopListenToKeyEvents(){this._domElementKeyEvents!==null&&(this._domElementKeyEvents.removeEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=null)}saveState(){this.target0.copy(this.target),this.position0.copy(this.object.position),this.zoom0=this.object.zoom}reset(){this.target.copy(this.target0),this.object.position.copy(this.position0),this.object.zoom=this.zoom0,this.object.updateProjectionMatrix(),this.dispatchEvent(Zb),this.update(),this.state=st.NONE}pan(e,t){this._pan(e,t),this.update()}dollyIn(e){this._dollyIn(e),this.update()}dollyOut(e){this._dollyOut(e),this.update()}rotateLeft(e){this._rotateLeft(e),this.update()}rotateUp(e){this._rotateUp(e),this.update()}update(e=null){let t=this.object.position;zt.copy(t).sub(this.target),zt.applyQuaternion(this._quat),this._spherical.setFromVector3(zt),this.autoRotate&&this.state===st.NONE&&this._rotateLeft(this._getAutoRotationAngle(e)),this.enableDamping?(this._spherical.theta+=this._sphericalDelta.theta*this.dampingFactor,this._spherical.phi+=this._sphericalDelta.phi*this.dampingFactor):(this._spherical.theta+=this._sphericalDelta.theta,this._spherical.phi+=this._sphericalDelta.phi);let i=this.minAzimuthAngle,s=this.maxAzimuthAngle;isFinite(i)&&isFinite(s)&&(i<-Math.PI?i+=Rn:i>Math.PI&&(i-=Rn),s<-Math.PI?s+=Rn:s>Math.PI&&(s-=Rn),i<=s?this._spherical.theta=Math.max(i,Math.min(s,this._spherical.theta)):this._spherical.theta=this._spherical.theta>(i+s)/2?Math.max(i,this._spherical.theta):Math.min(s,this._spherical.theta)),this._spherical.phi=Math.max(this.minPolarAngle,Math.min(this.maxPolarAngle,this._spherical.phi)),this._spherical.makeSafe(),this.enableDamping===!0?this.target.addScaledVector(this._panOffset,this.dampingFactor):this.target.add(this._panOffset),this.target.sub(this.cursor),this.target.clampLength(this.minTargetRadius,this.maxTargetRadius),this.target.add(this.cursor);let r=!1;if(this.zoomToCursor&&this._performCursorZoom||this.object.isOrthographicCamera)this._spherical.radius=this._clampDistance(this._spherical.radius);else{let o=this._spherical.radius;this._spherical.radius=this._clampDistance(this._spherical.radius*this._scale),r=o!=this._spherical.radius}if(zt.setFromSpherical(this._spherical),zt.applyQuaternion(this._quatInverse),t.copy(this.target).add(zt),this.object.lookAt(this.target),this.enableDamping===!0?(this._sphericalDelta.theta*=1-this.dampingFactor,this._sphericalDelta.phi*=1-this.dampingFactor,this._panOffset.multiplyScalar(1-this.dampingFactor)):(this._sphericalDelta.set(0,0,0),this._panOffset.set(0,0,0)),this.zoomToCursor&&this._performCursorZoom){let o=null;if(this.object.isPerspectiveCamera){let a=zt.length();o=this._clampDistance(a*this._scale);let l=a-o;this.object.position.addScaledVector(this._dollyDirection,l),this.object.updateMatrixWorld(),r=!!l}else if(this.object.isOrthographicCamera){let a=new F(this._mouse.x,this._mouse.y,0);a.unproject(this.object);let l=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),this.object.updateProjectionMatrix(),r=l!==this.object.zoom;let c=new F(this._mouse.x,this._mouse.y,0);c.unproject(this.object),this.object.position.sub(c).add(a),this.object.updateMatrixWorld(),o=zt.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),this.zoomToCursor=!1;o!==null&&(this.screenSpacePanning?this.target.set(0,0,-1).transformDirection(this.object.matrix).multiplyScalar(o).add(this.object.position):(qc.origin.copy(this.object.position),qc.direction.set(0,0,-1).transformDirection(this.object.matrix),Math.abs(this.object.up.dot(qc.direction))<Bw?this.object.lookAt(this.target):(Hb.setFromNormalAndCoplanarPoint(this.object.up,this.target),qc.intersectPlane(Hb,this.target))))}else if(this.object.isOrthographicCamera){let o=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),o!==this.object.zoom&&(this.object.updateProjectionMatrix(),r=!0)}return this._scale=1,this._performCursorZoom=!1,r||this._lastPosition.distanceToSquared(this.object.position)>Qh||8*(1-this._lastQuaternion.dot(this.object.quaternion))>Qh||this._lastTargetPosition.distanceToSquared(this.target)>Qh?(this.dispatchEvent(Zb),this._lastPosition.copy(this.object.position),this._lastQuaternion.copy(this.object.quaternion),this._lastTargetPosition.copy(this.target),!0):!1}_getAutoRotationAngle(e){return e!==null?Rn/60*this.autoRotateSpeed*e:Rn/60/60*this.autoRotateSpeed}_getZoomScale(e){let t=Math.abs(e*.01);return Math.pow(.95,this.zoomSpeed*t)}_rotateLeft(e){this._sphericalDelta.theta-=e}_rotateUp(e){this._sphericalDelta.phi-=e}_panLeft(e,t){zt.setFromMatrixColumn(t,0),zt.multiplyScalar(-e),this._panOffset.add(zt)}_panUp(e,t){this.screenSpacePanning===!0?zt.setFromMatrixColumn(t,1):(zt.setFromMatrixColumn(t,0),zt.crossVectors(this.object.up,zt)),zt.multiplyScalar(e),this._panOffset.add(zt)}_pan(e,t){let i=this.domElement;if(this.object.isPerspectiveCamera){let s=this.object.position;zt.copy(s).sub(this.target);let r=zt.length();r*=Math.tan(this.object.fov/2*Math.PI/180),this._panLeft(2*e*r/i.clientHeight,this.object.matrix),this._panUp(2*t*r/i.clientHeight,this.object.matrix)}else this.object.isOrthographicCamera?(this._panLeft(e*(this.object.right-this.object.left)/this.object.zoom/i.clientWidth,this.object.matrix),this._panUp(t*(this.object.top-this.object.bottom)/this.object.zoom/i.clientHeight,this.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),this.enablePan=!1)}_dollyOut(e){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale/=e:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_dollyIn(e){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale*=e:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_updateZoomParameters(e,t){if(!this.zoomToCursor)return;this._performCursorZoom=!0;let i=this.domElement.getBoundingClientRect(),s=e-i.left,r=t-i.top,o=i.width,a=i.height;this._mouse.x=s/o*2-1,this._mouse.y=-(r/a)*2+1,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()}_clampDistance(e){return Math.max(this.minDistance,Math.min(this.maxDistance,e))}_handleMouseDownRotate(e){this._rotateStart.set(e.clientX,e.clientY)}_handleMouseDownDolly(e){this._updateZoomParameters(e.clientX,e.clientY),this._dollyStart.set(e.clientX,e.clientY)}_handleMouseDownPan(e){this._panStart.set(e.clientX,e.clientY)}_handleMouseMoveRotate(e){this._rotateEnd.set(e.clientX,e.clientY),this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let t=this.domElement;this._rotateLeft(Rn*this._rotateDelta.x/t.clientHeight),this._rotateUp(Rn*this._rotateDelta.y/t.clientHeight),this._rotateStart.copy(this._rotateEnd),this.update()}_handleMouseMoveDolly(e){this._dollyEnd.set(e.clientX,e.clientY),this._dollyDelta.subVectors(this._dollyEnd,this._dollyStart),this._dollyDelta.y>0?this._dollyOut(this._getZoomScale(this._dollyDelta.y)):this._dollyDelta.y<0&&this._dollyIn(this._getZoomScale(this._dollyDelta.y)),this._dollyStart.copy(this._dollyEnd),this.zoomToCursor&&(this._performCursorZoom=!0,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()),this.update()}_handleMouseMovePan(e){this._panEnd.set(e.clientX,e.clientY),this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd),this.update()}_handleMouseWheel(e){this._updateZoomParameters(e.clientX,e.clientY),e.deltaY<0?this._dollyIn(this._getZoomScale(e.deltaY)):e.deltaY>0&&this._dollyOut(this._getZoomScale(e.deltaY)),this.update()}_handleKeyDown(e){let t=!1;switch(e.code){case this.keys.UP:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateUp(Rn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,this.keyPanSpeed),t=!0;break;case this.keys.BOTTOM:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateUp(-Rn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,-this.keyPanSpeed),t=!0;break;case this.keys.LEFT:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateLeft(Rn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(this.keyPanSpeed,0),t=!0;break;case this.keys.RIGHT:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateLeft(-Rn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(-this.keyPanSpeed,0),t=!0;break}t&&(e.preventDefault(),this.update())}_handleTouchStartRotate(e){if(this._pointers.length===1)this._rotateStart.set(e.pageX,e.pageY);else{let t=this._getSecondPointerPosition(e),i=.5*(e.pageX+t.x),s=.5*(e.pageY+t.y);this._rotateStart.set(i,s)}}_handleTouchStartPan(e){if(this._pointers.length===1)this._panStart.set(e.pageX,e.pageY);else{let t=this._getSecondPointerPosition(e),i=.5*(e.pageX+t.x),s=.5*(e.pageY+t.y);this._panStart.set(i,s)}}_handleTouchStartDolly(e){let t=this._getSecondPointerPosition(e),i=e.pageX-t.x,s=e.pageY-t.y,r=Math.sqrt(i*i+s*s);this._dollyStart.set(0,r)}_handleTouchStartDollyPan(e){this.enableZoom&&this._handleTouchStartDolly(e),this.enablePan&&this._handleTouchStartPan(e)}_handleTouchStartDollyRotate(e){this.enableZoom&&this._handleTouchStartDolly(e),this.enableRotate&&this._handleTouchStartRotate(e)}_handleTouchMoveRotate(e){if(this._pointers.length==1)this._rotateEnd.set(e.pageX,e.pageY);else{let i=this._getSecondPointerPosition(e),s=.5*(e.pageX+i.x),r=.5*(e.pageY+i.y);this._rotateEnd.set(s,r)}this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let t=this.domElement;this._rotateLeft(Rn*this._rotateDelta.x/t.clientHeight),this._rotateUp(Rn*this._rotateDelta.y/t.clientHeight),this._rotateStart.copy(this._rotateEnd)}_handleTouchMovePan(e){if(this._pointers.length===1)this._panEnd.set(e.pageX,e.pageY);else{let t=this._getSecondPointerPosition(e),i=.5*(e.pageX+t.x),s=.5*(e.pageY+t.y);this._panEnd.set(i,s)}this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd)}_handleTouchMoveDolly(e){let t=this._getSecondPointerPosition(e),i=e.pageX-t.x,s=e.pageY-t.y,r=Math.sqrt(i*i+s*s);this._dollyEnd.set(0,r),this._dollyDelta.set(0,Math.pow(this._dollyEnd.y/this._dollyStart.y,this.zoomSpeed)),this._dollyOut(this._dollyDelta.y),this._dollyStart.copy(this._dollyEnd);let o=(e.pageX+t.x)*.5,a=(e.pageY+t.y)*.5;this._updateZoomParameters(o,a)}_handleTouchMoveDollyPan(e){this.enableZoom&&this._handleTouchMoveDolly(e),this.enablePan&&this._handleTouchMovePan(e)}_handleTouchMoveDollyRotate(e){this.enableZoom&&this._handleTouchMoveDolly(e),this.enableRotate&&this._handleTouchMoveRotate(e)}_addPointer(e){this._pointers.push(e.pointerId)}_removePointer(e){delete this._pointerPositions[e.pointerId];for(let t=0;t<this._pointers.length;t++)if(this._pointers[t]==e.pointerId){this._pointers.splice(t,1);return}}_isTrackingPointer(e){for(let t=0;t<this._pointers.length;t++)if(this._pointers[t]==e.pointerId)return!0;return!1}_trackPointer(e){let t=this._pointerPositions[e.pointerId];t===void 0&&(t=new Be,this._pointerPositions[e.pointerId]=t),t.set(e.pageX,e.pageY)}_getSecondPointerPosition(e){let t=e.pointerId===this._pointers[0]?this._pointers[1]:this._pointers[0];return this._pointerPositions[t]}_customWheelEvent(e){let t=e.deltaMode,i={clientX:e.clientX,clientY:e.clientY,deltaY:e.deltaY};switch(t){case 1:i.deltaY*=16;break;case 2:i.deltaY*=100;break}return e.ctrlKey&&!this._controlActive&&(i.deltaY*=10),i}};function Lw(n){this.enabled!==!1&&(this._pointers.length===0&&(this.domElement.setPointerCapture(n.pointerId),this.domElement.ownerDocument.addEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.addEventListener("pointerup",this._onPointerUp)),!this._isTrackingPointer(n)&&(this._addPointer(n),n.pointerType==="touch"?this._onTouchStart(n):this._onMouseDown(n),this._cursorStyle==="grab"&&(this.domElement.style.cursor="grabbing")))}function Fw(n){this.enabled!==!1&&(n.pointerType==="touch"?this._onTouchMove(n):this._onMouseMove(n))}function Uw(n){switch(this._removePointer(n),this._pointers.length){case 0:this.domElement.releasePointerCapture(n.pointerId),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.dispatchEvent(Yb),this.state=st.NONE,this._cursorStyle==="grab"&&(this.domElement.style.cursor="grab");break;case 1:let e=this._pointers[0],t=this._pointerPositions[e];this._onTouchStart({pointerId:e,pageX:t.x,pageY:t.y});break}}function Pw(n){let e;switch(n.button){case 0:e=this.mouseButtons.LEFT;break;case 1:e=this.mouseButtons.MIDDLE;break;case 2:e=this.mouseButtons.RIGHT;break;default:e=-1}switch(e){case ss.DOLLY:if(this.enableZoom===!1)return;this._handleMouseDownDolly(n),this.state=st.DOLLY;break;case ss.ROTATE:if(n.ctrlKey||n.metaKey||n.shiftKey){if(this.enablePan===!1)return;this._handleMouseDownPan(n),this.state=st.PAN}else{if(this.enableRotate===!1)return;this._handleMouseDownRotate(n),this.state=st.ROTATE}break;case ss.PAN:if(n.ctrlKey||n.metaKey||n.shiftKey){if(this.enableRotate===!1)return;this._handleMouseDownRotate(n),this.state=st.ROTATE}else{if(this.enablePan===!1)return;this._handleMouseDownPan(n),this.state=st.PAN}break;default:this.state=st.NONE}this.state!==st.NONE&&this.dispatchEvent(Kh)}function Dw(n){switch(this.state){case st.ROTATE:if(this.enableRotate===!1)return;this._handleMouseMoveRotate(n);break;case st.DOLLY:if(this.enableZoom===!1)return;this._handleMouseMoveDolly(n);break;case st.PAN:if(this.enablePan===!1)return;this._handleMouseMovePan(n);break}}function Gw(n){this.enabled===!1||this.enableZoom===!1||this.state!==st.NONE||(n.preventDefault(),this.dispatchEvent(Kh),this._handleMouseWheel(this._customWheelEvent(n)),this.dispatchEvent(Yb))}function Vw(n){this.enabled!==!1&&this._handleKeyDown(n)}function Ow(n){switch(this._trackPointer(n),this._pointers.length){case 1:switch(this.touches.ONE){case li.ROTATE:if(this.enableRotate===!1){this.state=st.NONE;break}this._handleTouchStartRotate(n),this.state=st.TOUCH_ROTATE;break;case li.PAN:if(this.enablePan===!1){this.state=st.NONE;break}this._handleTouchStartPan(n),this.state=st.TOUCH_PAN;break;default:this.state=st.NONE}break;case 2:switch(this.touches.TWO){case li.DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchStartDollyPan(n),this.state=st.TOUCH_DOLLY_PAN;break;case li.DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchStartDollyRotate(n),this.state=st.TOUCH_DOLLY_ROTATE;break;default:this.state=st.NONE}break;default:this.state=st.NONE}this.state!==st.NONE&&this.dispatchEvent(Kh)}function kw(n){switch(this._trackPointer(n),this.state){case st.TOUCH_ROTATE:if(this.enableRotate===!1)return;this._handleTouchMoveRotate(n),this.update();break;case st.TOUCH_PAN:if(this.enablePan===!1)return;this._handleTouchMovePan(n),this.update();break;case st.TOUCH_DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchMoveDollyPan(n),this.update();break;case st.TOUCH_DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchMoveDollyRotate(n),this.update();break;default:this.state=st.NONE}}function Ww(n){this.enabled!==!1&&n.preventDefault()}function zw(n){n.key==="Control"&&(this._controlActive=!0,this.domElement.ownerDocument.addEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function Xw(n){n.key==="Control"&&(this._controlActive=!1,this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}var eu=class{parts;constructor(e){this.parts=e.segments.map(t=>{let i=Float32Array.from(t.meshVerticesM),s=new En().setFromArray(i).getBoundingSphere(new An);return{corners:i,triangles:t.meshTriangles,bound:s}})}touch(e,t,i){let s,r;return this.parts.forEach((o,a)=>{if(!o.corners.length)return;let l=a*At;jh.set(t[l+3],t[l+4],t[l+5],t[l+6]).conjugate(),as.origin.set(e.origin.x-t[l],e.origin.y-t[l+1],e.origin.z-t[l+2]).applyQuaternion(jh),as.direction.copy(e.direction).applyQuaternion(jh);let c=as.origin.distanceTo(o.bound.center);if(as.distanceToPoint(o.bound.center)>o.bound.radius+c*i)return;let{corners:u,triangles:h}=o;for(let p=0;p+2<h.length;p+=3){if(ra.fromArray(u,3*h[p]),$c.fromArray(u,3*h[p+1]),Jb.fromArray(u,3*h[p+2]),!as.intersectTriangle(ra,$c,Jb,!0,qh))continue;let d=qh.distanceTo(as.origin);(!s||d<s.distance)&&(s={segment:a,local:qh.clone(),distance:d,off:0})}if(!s)for(let p=0;p+2<u.length;p+=3){ra.fromArray(u,p);let d=$c.subVectors(ra,as.origin).angleTo(as.direction);d<=i&&(!r||d<r.off)&&(r={segment:a,local:ra.clone(),distance:$c.length(),off:d})}}),s??r}},[ra,$c,Jb,qh]=[new F,new F,new F,new F],jh=new en,as=new oi;var $h={light:{sky:15330800,ground:16448508,line:"#d2d9de",body:12174540,ghost:3112349,sun:2.4,fill:1.7},dark:{sky:1514786,ground:3752522,line:"#4c5862",body:10003887,ghost:7128032,sun:1.7,fill:1.1}},Bs={com:29362,zmp:13983232,force:40563,push:13400487,support:5682409},Zw=1/700,Hw=16,ls=18,oa=[.3,.3,.22];function Yw(n){let e={used:{value:new Float32Array(ls)},atLimit:{value:new Float32Array(ls)},shown:{value:1},chosen:{value:0}},t=new Di({color:n});return t.onBeforeCompile=i=>{i.uniforms.uUsed=e.used,i.uniforms.uAtLimit=e.atLimit,i.uniforms.uShown=e.shown,i.uniforms.uChosen=e.chosen,i.vertexShader=i.vertexShader.replace("#include <common>",`#include <common>
attribute float segment;
uniform float uUsed[${ls}];
uniform float uAtLimit[${ls}];
varying float vUsed;
varying float vAtLimit;
varying vec3 vPlace;`).replace("#include <begin_vertex>",`#include <begin_vertex>
int index = int(segment + 0.5);
vUsed = uUsed[index];
vAtLimit = uAtLimit[index];
vPlace = position;`),i.fragmentShader=i.fragmentShader.replace("#include <common>",`#include <common>
uniform float uShown;
uniform float uChosen;
varying float vUsed;
varying float vAtLimit;
varying vec3 vPlace;`).replace("#include <color_fragment>",`#include <color_fragment>
vec3 warm = mix(vec3(0.87, 0.52, 0.05), vec3(0.62, 0.09, 0.0), smoothstep(0.6, 1.0, vUsed));
diffuseColor.rgb = mix(diffuseColor.rgb, warm, uShown * smoothstep(0.2, 0.75, vUsed));
float stripe = step(0.5, fract((vPlace.x + vPlace.y + vPlace.z) * 22.0));
diffuseColor.rgb = mix(diffuseColor.rgb, vec3(1.0, 0.86, 0.55), uShown * vAtLimit * stripe);`).replace("#include <opaque_fragment>",`float rim = pow(1.0 - saturate(dot(normalize(vViewPosition), normal)), 2.5);
outgoingLight += uChosen * rim * vec3(0.15, 0.5, 0.7);
#include <opaque_fragment>`)},{material:t,effort:e}}var Jw=.34;function Qw(n){let e={value:new Float32Array(ls)},t=new yi({color:n,transparent:!0,opacity:Jw,depthWrite:!1,polygonOffset:!0,polygonOffsetFactor:1,polygonOffsetUnits:4});return t.onBeforeCompile=i=>{i.uniforms.uFade=e,i.vertexShader=i.vertexShader.replace("#include <common>",`#include <common>
attribute float segment;
uniform float uFade[${ls}];
varying float vFade;`).replace("#include <begin_vertex>",`#include <begin_vertex>
vFade = uFade[int(segment + 0.5)];`),i.fragmentShader=i.fragmentShader.replace("#include <common>",`#include <common>
varying float vFade;`).replace("#include <color_fragment>",`#include <color_fragment>
if (vFade <= 0.0) discard;
diffuseColor.a *= vFade;`)},{material:t,fade:e}}function Kw(n){let e=[],t=[],i=[];n.segments.forEach((a,l)=>{let c=e.length/3;for(let u of a.meshVerticesM)e.push(u);for(let u of a.meshTriangles)t.push(c+u);for(let u=0;u<a.meshVerticesM.length/3;u++)i.push(l)});let s=new Ot;s.setAttribute("position",new ft(e,3)),s.setIndex(t),s.computeVertexNormals(),s.setAttribute("segment",new ft(i,1));let r=new Uint16Array(i.length*4),o=new Float32Array(i.length*4);return i.forEach((a,l)=>{r[4*l]=a,o[4*l]=1}),s.setAttribute("skinIndex",new _s(r,4)),s.setAttribute("skinWeight",new ft(o,4)),s.boundingSphere=new An(new F,1e4),s}var tu=class{mesh;bones;poses;constructor(e,t,i){this.bones=Array.from({length:i},()=>{let s=new Sr;return s.matrixAutoUpdate=!1,s.matrixWorldAutoUpdate=!1,s}),this.poses=new Float32Array(i*At),this.mesh=new Ro(e,t),this.mesh.frustumCulled=!1,this.mesh.bind(new To(this.bones,this.bones.map(()=>new Ye)),new Ye)}place(){let[e,t,i]=[wn,e0,jw];this.bones.forEach((s,r)=>{let o=r*At;e.set(this.poses[o],this.poses[o+1],this.poses[o+2]),t.set(this.poses[o+3],this.poses[o+4],this.poses[o+5],this.poses[o+6]),s.matrixWorld.compose(e,t,i)})}dispose(){this.mesh.skeleton.dispose(),this.mesh.material.dispose()}},wn=new F,Br=new F,$b=new F,e0=new en,qw=new fn,jw=new F(1,1,1);function t0(n){let e=new Nn,t=new yi({color:n}),i=new Mt($w,t),s=new Mt(eT,t);return e.add(i,s),e.visible=!1,e}var $w=new _r(.01,.01,1,8).translate(0,.5,0),eT=new Uo(.024,.06,12).translate(0,.03,0),tT=new F(0,1,0);function n0(n,e,t){let i=t.length();if(n.visible=i>.01,!n.visible)return;let[s,r]=n.children,o=Math.max(.001,i-.06);s.scale.set(1,o,1),r.position.y=o,n.position.copy(e),n.quaternion.setFromUnitVectors(tT,$b.copy(t).divideScalar(i))}var ep=class{constructor(e,t){this.person=e;let i=Kw(e.body),s=e.body.segments.length,{material:r,effort:o}=Yw(t.body);this.effort=o,this.solid=new tu(i,r,s),this.solid.mesh.castShadow=!0,this.solid.mesh.receiveShadow=!0;let a=Qw(t.ghost);this.fade=a.fade,this.ghost=new tu(i,a.material,s),this.reach=e.body.segments.map(l=>{let c=0,u=l.meshVerticesM;for(let h=0;h+2<u.length;h+=3)c=Math.max(c,Math.hypot(u[h],u[h+1],u[h+2]));return c}),this.ghost.mesh.renderOrder=2,this.touchable=new eu(e.body),this.hands=[e.segment("l_hand"),e.segment("r_hand")],this.crate=lT();for(let l=0;l<iT;l++){let c=new Mt(sT,rT);c.castShadow=!0,this.weights.push(c)}this.polygon.renderOrder=1,this.zmp.renderOrder=3,this.com.renderOrder=4,this.com.material.depthTest=!1;for(let l=0;l<Hw;l++)this.arrows.push(t0(Bs.force));this.group.add(this.solid.mesh,this.ghost.mesh,this.crate,...this.weights,this.polygon,this.outline,this.com,this.plumb,this.zmp,...this.arrows),this.group.visible=!1,this.group.traverse(l=>{(l instanceof Mt||l instanceof As)&&(l.frustumCulled=!1)})}person;group=new Nn;solid;ghost;fade;reach;effort;crate;weights=[];polygon=new Mt(new Ot,new yi({color:Bs.support,transparent:!0,opacity:.35,depthWrite:!1,side:xn}));outline=new Co(new Ot,new Es({color:Bs.support,transparent:!0}));com=new Mt(oT,new yi({color:Bs.com}));plumb=new As(new Ot().setFromPoints([new F,new F]),new Es({color:Bs.com,transparent:!0,opacity:.6}));zmp=new Mt(aT,new yi({color:Bs.zmp,transparent:!0,depthWrite:!1,side:xn}));arrows=[];hands;touchable;repaint(e){this.solid.mesh.material.color.set(e.body),this.ghost.mesh.material.color.set(e.ghost)}update(e,t,i,s,r){let o=Tt(t.segmentTransforms);o.length===this.solid.poses.length&&(oo(Tt(e.segmentTransforms),o,i,this.solid.poses),this.solid.place(),this.tint(s.effort,r),this.showGhost(e,t,i,s.ghost),this.showLoads(t),this.showSupport(t,s.support),this.showForces(t,s.forces))}tint(e,t){let{used:i,atLimit:s}=this.effort;i.value.fill(0),s.value.fill(0),this.person.body.dofs.forEach((r,o)=>{i.value[r.joint]=Math.max(i.value[r.joint],this.person.used[o]),Number.isNaN(this.person.limitSince[o])||(s.value[r.joint]=1)}),this.effort.shown.value=e?1:0,this.effort.chosen.value=t?1:0}wanted=[new Float32Array(At*ls),new Float32Array(At*ls)];showGhost(e,t,i,s){let[r,o]=[e.desired??t.desired,t.desired],a=Tt(o?.jointRotations);if(this.ghost.mesh.visible=s&&a.length===4*(this.person.body.segments.length-1),!this.ghost.mesh.visible||!r||!o)return;wd(this.person.body,Tt(r.rootPose),Tt(r.jointRotations),this.wanted[0]),wd(this.person.body,Tt(o.rootPose),a,this.wanted[1]),oo(this.wanted[0],this.wanted[1],i,this.ghost.poses);let l=!1;this.reach.forEach((c,u)=>{this.fade.value[u]=Og(kg(this.ghost.poses,this.solid.poses,u*At,c)),l||=this.fade.value[u]>0}),this.ghost.mesh.visible=l,l&&this.ghost.place()}showLoads(e){let t=e.status?.loads??[],i=(p,d)=>{let{segment:f,pointM:b}=t[p];return this.world(f,d.set(b?.x??0,b?.y??0,b?.z??0),d)},[s,r]=this.hands.map(p=>t.findIndex(d=>d.segment===p)),o=s>=0&&r>=0&&t.length===2&&this.person.holdsCrate();if(this.crate.visible=o,this.weights.forEach((p,d)=>{p.visible=!o&&d<t.length&&t[d].massKg>0,p.visible&&(i(d,p.position),p.scale.setScalar(Math.cbrt(t[d].massKg/nT)))}),!o)return;let a=i(s,wn),l=i(r,Br);this.crate.position.copy(a).add(l).multiplyScalar(.5);let c=a.clone().sub(l),u=c.length();c.divideScalar(u||1);let h=new F(0,0,1).addScaledVector(c,-c.z);h.lengthSq()<.01&&h.set(1,0,0).addScaledVector(c,-c.x),h.normalize(),this.crate.quaternion.setFromRotationMatrix(new Ye().makeBasis(new F().crossVectors(c,h),c,h)),this.crate.scale.set(1,Math.max(.4,u/oa[1]),1)}showSupport(e,t){let i=e.balance,s=Tt(i?.polygon),r=Tt(i?.zmp),o=Tt(i?.com);if(this.polygon.visible=this.outline.visible=t&&s.length>=6,this.polygon.visible){let a=s.length/2,l=new Float32Array(3*a),c=[];for(let u=0;u<a;u++)l.set([s[2*u],s[2*u+1],.004],3*u),u>=2&&c.push(0,u-1,u);for(let u of[this.polygon,this.outline]){let h=u.geometry.getAttribute("position");h?.count===a?(h.array.set(l),h.needsUpdate=!0):(u.geometry.dispose(),u.geometry=new Ot,u.geometry.setAttribute("position",new Xn(l.slice(),3)),u===this.polygon&&u.geometry.setIndex(c))}}if(this.zmp.visible=t&&r.length===3,this.zmp.visible&&this.zmp.position.set(r[0],r[1],.008),this.com.visible=this.plumb.visible=t&&o.length===3,this.com.visible){this.com.position.set(o[0],o[1],o[2]);let a=this.plumb.geometry.getAttribute("position");a.setXYZ(0,o[0],o[1],o[2]),a.setXYZ(1,o[0],o[1],.005),a.needsUpdate=!0}}showForces(e,t){let i=Tt(e.contacts?.position),s=Tt(e.contacts?.force),r=new Map;e.contacts?.segment.forEach((a,l)=>{let c=r.get(a);c||r.set(a,c={force:new F,place:new F,weight:0}),Br.fromArray(s,3*l);let u=Br.length();c.force.add(Br),c.place.addScaledVector(wn.fromArray(i,3*l),u),c.weight+=u});let o=t?[...r.values()].filter(a=>a.weight>1):[];this.arrows.forEach((a,l)=>{let c=o[l];c?n0(a,c.place.divideScalar(c.weight),c.force.multiplyScalar(Zw)):a.visible=!1})}touch(e,t){let i=this.touchable.touch(e.ray,this.solid.poses,t),s=e.intersectObjects([this.crate,...this.weights].filter(a=>a.visible))[0];if(!s||i&&i.off===0&&i.distance<=s.distance)return i;let r,o=1/0;for(let{segment:a,pointM:l}of this.person.frame?.status?.loads??[]){let c=new F(l?.x??0,l?.y??0,l?.z??0),u=this.world(a,c,wn).distanceTo(s.point);u<o&&([o,r]=[u,{segment:a,local:c,distance:s.distance,off:0}])}return r}world(e,t,i){let s=e*At;return i.copy(t).applyQuaternion(e0.fromArray(this.solid.poses,s+3)).add($b.fromArray(this.solid.poses,s))}top(e){let i=Math.max(0,this.person.segment("head"))*At;return e.set(this.solid.poses[i],this.solid.poses[i+1],this.solid.poses[i+2]+.3)}dispose(){this.solid.mesh.geometry.dispose(),this.solid.dispose(),this.ghost.dispose()}},nT=32e3,iT=8,sT=new es(1,24,16),rT=new Di({color:3818314}),oT=new es(.028,16,12),aT=new Po(.022,.04,24);function lT(){let n=new Nn,e=new Mt(new ai(...oa),new Di({color:12159828}));e.castShadow=!0,e.receiveShadow=!0;let t=new Di({color:9069366});n.add(e);for(let i of[-.5,.5])for(let s of[-.5,.5]){let r=new Mt(new ai(.03,oa[1]*1.02,.03),t);r.position.set(s*oa[0],0,i*oa[2]),r.castShadow=!0,n.add(r)}return n}var Qb=80,cT=200,Kb=84,uT=6,qb={mouse:8,touch:22},dT=.3,jb={least:.45,most:1.4},hT=.002,Lr=class{constructor(e,t){this.canvas=e;this.on=t;this.renderer=new Jc({canvas:e,antialias:!0}),this.renderer.shadowMap.enabled=!0,this.renderer.shadowMap.type=Ms,this.renderer.toneMapping=Ho,this.camera.up.set(0,0,1),this.camera.position.set(4.4,-2.7,1.9),this.orbit=new jc(this.camera,e),this.orbit.target.set(.15,0,.85),this.orbit.maxPolarAngle=Math.PI*.495,this.orbit.minDistance=.8,this.orbit.maxDistance=40,this.orbit.enableDamping=!0,this.orbit.dampingFactor=.12,this.orbit.addEventListener("start",()=>{this.moved=!0,this.dragged=this.orbit.target.clone()}),this.orbit.addEventListener("end",()=>{this.endFollowIfPanned(),this.dragged=void 0}),this.sun.castShadow=!0,this.sun.shadow.mapSize.set(2048,2048),this.sun.shadow.radius=5,this.sun.shadow.bias=-4e-4,this.sun.shadow.normalBias=.015,this.ground=new Mt(new Pi(160,160),new Di),this.ground.receiveShadow=!0,this.scene.add(this.sun,this.sun.target,this.fill,this.ground,this.pushArrow),e.addEventListener("pointerdown",i=>this.press(i),{capture:!0}),e.addEventListener("pointermove",i=>this.move(i)),e.addEventListener("pointerup",()=>this.release(!0)),e.addEventListener("pointercancel",()=>this.release(!1)),new ResizeObserver(()=>this.resize()).observe(e.parentElement??e),this.resize()}canvas;on;renderer;scene=new Ao;camera=new mn(36,1,.05,200);orbit;actors=new Map;sun=new zo(16777215,2.4);fill=new Oo(16777215,9082012,1.4);ground;pushArrow=t0(Bs.push);look=$h.light;push;hovered;ray=new Xo;moved=!1;followed=!1;dragged;preparedAt=NaN;drawn=0;pushable=!0;resize(){let{clientWidth:e,clientHeight:t}=this.canvas.parentElement??this.canvas;!e||!t||(this.renderer.setPixelRatio(Math.min(2,devicePixelRatio)),this.renderer.setSize(e,t,!1),this.camera.aspect=e/t,this.camera.setViewOffset(e,t,0,Kb/2,e,t),this.moved||this.frameAll())}theme(e){this.look=e?$h.dark:$h.light,this.scene.background=new We(this.look.sky),this.scene.fog=new Eo(this.look.sky,14,48),this.sun.intensity=this.look.sun,this.fill.intensity=this.look.fill;let t=document.createElement("canvas");t.width=t.height=256;let i=t.getContext("2d");i&&(i.fillStyle="#"+new We(this.look.ground).getHexString(),i.fillRect(0,0,256,256),i.strokeStyle=this.look.line,i.lineWidth=2,i.strokeRect(0,0,256,256));let s=new No(t);s.wrapS=s.wrapT=fr,s.repeat.set(160,160),s.anisotropy=8,s.colorSpace=pn,this.ground.material.map?.dispose(),this.ground.material.map=s,this.ground.material.needsUpdate=!0;for(let r of this.actors.values())r.repaint(this.look)}add(e){this.scene.add(e)}populate(e){let t=new Map([...e].map(i=>[i.index,i]));for(let[i,s]of this.actors){let r=t.get(i);if(r?.body===s.person.body&&r.name===s.person.name){s.person=r;continue}this.scene.remove(s.group),s.dispose(),this.actors.delete(i)}for(let[i,s]of t){if(this.actors.has(i))continue;let r=new ep(s,this.look);this.actors.set(i,r),this.scene.add(r.group)}this.moved||this.frameAll()}frameAll(){let e=new En;for(let a of this.actors.values()){let l=a.person.figure.placement,c=a.solid.poses[0]||l?.xM||0,u=a.solid.poses[1]||l?.yM||0;e.expandByPoint(wn.set(c-.3,u-.45,0)),e.expandByPoint(wn.set(c+.75,u+.45,2.1))}if(e.isEmpty())return;let t=e.getBoundingSphere(new An),i=this.canvas.clientHeight||1,s=Math.atan(Math.tan(ki.degToRad(this.camera.fov/2))*Math.max(.5,1-Kb/i)),r=Math.min(s,Math.atan(Math.tan(ki.degToRad(this.camera.fov/2))*this.camera.aspect)),o=t.radius*.76/Math.sin(r);this.orbit.target.copy(t.center).setZ(.86),this.camera.position.copy(this.orbit.target).addScaledVector(wn.set(.9,-.36,.2).normalize(),o),this.orbit.update()}frameAllOnce(){this.moved||this.frameAll()}recentre(){this.follow=!1,this.moved=!1,this.frameAll()}get follow(){return this.followed}set follow(e){e!==this.followed&&(this.followed=e,e&&(this.moved=!0),this.orbit.touches.TWO=e?li.DOLLY_ROTATE:li.DOLLY_PAN,this.on.following(e))}track(e,t){let i=e&&this.actors.get(e.index);if(!this.followed||!i?.group.visible)return;let s=wn.fromArray(i.solid.poses);s.z=ki.clamp(s.z,jb.least,jb.most);let r=matchMedia("(prefers-reduced-motion: reduce)").matches,o=s.sub(this.orbit.target).multiplyScalar(r?1:1-Math.exp(-t/dT));this.orbit.target.add(o),this.camera.position.add(o),this.dragged?.add(o)}endFollowIfPanned(){this.followed&&this.dragged&&this.dragged.distanceTo(this.orbit.target)>hT&&(this.follow=!1)}turn(e,t,i){this.moved=!0;let s=this.camera.position.clone().sub(this.orbit.target);s.applyAxisAngle(wn.set(0,0,1),e);let r=wn.set(-s.y,s.x,0).normalize(),o=s.clone().applyAxisAngle(r,-t);o.z>.1&&o.z/o.length()<.995&&s.copy(o),s.setLength(ki.clamp(s.length()*i,this.orbit.minDistance,this.orbit.maxDistance)),this.camera.position.copy(this.orbit.target).add(s)}get place(){return this.moved?[...this.camera.position.toArray(),...this.orbit.target.toArray()].map(e=>Number(e.toFixed(2))):void 0}set place(e){e?.length!==6||!e.every(Number.isFinite)||(this.moved=!0,this.camera.position.fromArray(e),this.orbit.target.fromArray(e,3),this.orbit.update())}takeView(e){this.moved=!0,this.camera.position.copy(e.camera.position),this.orbit.target.copy(e.orbit.target)}prepare(e,t,i){let s=Br.set(0,0,0),r=2;if(e)for(let[c,u]of this.actors){let h=e.after.get(c);u.group.visible=!!h,h&&u.update(e.before.get(c)??h,h,e.share,t,u.person===i)}let o=new En;for(let c of this.actors.values())o.expandByPoint(wn.fromArray(c.solid.poses));o.isEmpty()||(o.getCenter(s),r=Math.max(2,o.getSize(wn).length()/2+1.6)),this.sun.target.position.set(s.x,s.y,0),this.sun.position.set(s.x+6+r,s.y-7-r,8+r);let a=this.sun.shadow.camera;Math.abs(a.right-r)>.2&&(a.left=a.bottom=-r,a.right=a.top=r,a.far=30+3*r,a.updateProjectionMatrix());let l=performance.now()/1e3;this.track(i,Number.isNaN(this.preparedAt)?0:Math.min(.5,l-this.preparedAt)),this.preparedAt=l,this.orbit.update(),this.endFollowIfPanned(),this.camera.updateMatrixWorld(),this.drawPush(),this.hovered&&(this.canvas.style.cursor=this.pick(this.hovered)?"crosshair":"grab",this.hovered=void 0)}draw3d(){this.renderer.render(this.scene,this.camera),[...this.actors.values()].some(e=>e.group.visible)&&this.drawn++}label(e){let t=this.actors.get(e.index);if(!t)return;let i=t.top(wn).project(this.camera);if(!(i.z>1||Math.abs(i.x)>1||Math.abs(i.y)>1))return{x:(i.x+1)/2*this.canvas.clientWidth,y:(1-i.y)/2*this.canvas.clientHeight}}aim(e,t){let i=this.canvas.getBoundingClientRect();this.ray.setFromCamera(new Be((e-i.left)/i.width*2-1,1-(t-i.top)/i.height*2),this.camera)}pick(e){this.aim(e.clientX,e.clientY);let i=ki.degToRad(this.camera.fov)/(this.canvas.clientHeight||1)*(e.pointerType==="mouse"?qb.mouse:qb.touch),s;for(let r of this.actors.values()){let o=r.group.visible?r.touch(this.ray,i):void 0;o&&(!s||o.off<s.touch.off||o.off===s.touch.off&&o.distance<s.touch.distance)&&(s={actor:r,touch:o})}return s}press(e){if(e.button!==0||!e.isPrimary)return;let t=this.pick(e);if(!t)return;let{actor:i,touch:s}=t,{person:r}=i;if(!this.pushable)return this.on.choose(r);let o=new Be(e.clientX,e.clientY);this.push={actor:i,segment:s.segment,drawn:{person:r,segment:r.body.segments[s.segment].name,local:s.local,impulse:new F},start:o.clone(),pointer:o},this.orbit.enabled=!1,this.canvas.setPointerCapture(e.pointerId),this.on.choose(r)}move(e){this.push?(this.push.pointer.set(e.clientX,e.clientY),this.drawPush()):e.pointerType==="mouse"&&!e.buttons&&(this.hovered=e)}drawPush(){if(!this.push)return;let{actor:e,segment:t,drawn:i,start:s,pointer:r}=this.push;if(this.actors.get(e.person.index)!==e)return this.release(!1);let o=e.world(t,i.local,new F);this.aim(r.x,r.y);let a=this.ray.ray.intersectPlane(qw.setFromNormalAndCoplanarPoint(this.camera.getWorldDirection(wn),o),Br);if(!a)return;let l=a.clone().sub(o).clampLength(0,cT/Qb);s.distanceTo(r)<uT&&l.setScalar(0),i.impulse.copy(l).multiplyScalar(Qb),n0(this.pushArrow,o,l);let c=this.canvas.getBoundingClientRect();this.on.pushing(l.lengthSq()>0?i:void 0,r.x-c.left,r.y-c.top)}release(e){let t=this.push;this.push=void 0,this.orbit.enabled=!0,this.pushArrow.visible=!1,t&&(this.on.pushing(void 0,0,0),e&&t.drawn.impulse.lengthSq()>0&&this.on.push(t.drawn))}};var tp=30,pT=12e3,i0=5,s0=.15,r0=3e3,fT=5e3,mT=512,gT=new Set([1,2,3,4,31,32,35,40,41,42,43,44]),vn=n=>Number(n.tick),nu=class{constructor(e,t,i){this.api=e;this.world=t;this.fields=i}api;world;fields;oldest=-1;newest=-1;events=[];version=0;rateHz=60;trouble="";kept=[];epoch=0;seen=-1;focus;reading;asked=new Map;looked=-1/0;get divisor(){return Math.max(1,Math.round(this.rateHz/tp))}add(e,t){this.rateHz=t.rateHz||this.rateHz;let i=vn(e);this.epoch&&(e.epoch!==this.epoch||i<this.seen)&&this.forget(i),this.epoch=e.epoch,this.seen=i,this.newest=Math.max(this.newest,i);let s=this.kept.at(-1);s&&vn(s.frame)===i?this.kept[this.kept.length-1]={frame:e,roster:t}:(!s||i%this.divisor===0||i-vn(s.frame)>=this.divisor)&&this.kept.push({frame:e,roster:t}),this.bound(),performance.now()-this.looked>fT&&this.look()}happened(e){gT.has(e.type)||(e.type===45&&(this.events=this.events.filter(t=>t.tick<=e.tick)),this.events.push(e),this.events.length>mT&&this.events.shift(),this.version++)}forget(e){this.reading?.stop.abort(),this.asked.clear(),this.kept=this.kept.filter(t=>vn(t.frame)<e),this.events=this.events.filter(t=>vn(t)<=e),this.newest=e,this.looked=-1/0,this.version++}async look(){this.looked=performance.now();let{epoch:e}=this;try{let t=await this.api.history.getHistory({name:this.world});if(e&&e!==this.epoch)return;this.oldest=Number(t.oldestTick),this.newest=Math.max(this.newest,Number(t.newestTick));let i=t.newestTick;this.events=[...t.events,...this.events.filter(s=>s.tick>i)],this.version++}catch{}}lookAt(e){this.focus=e===void 0?void 0:e*this.rateHz,this.focus===void 0?this.reading?.stop.abort():this.fetch()}at(e){let{kept:t}=this;if(!t.length)return;let i=this.first(e*this.rateHz),[s,r]=[t[i-1],t[i]],o=1.5/this.rateHz;if(s&&r){let[c,u]=[s.frame.timeS,r.frame.timeS];if(u-c<=s0)return{before:s,after:r,share:(e-c)/(u-c),exact:!0};let h=e-c<u-e?s:r;return{before:h,after:h,share:1,exact:Math.abs(h.frame.timeS-e)<o}}let a=s??r,l=Math.abs(a.frame.timeS-e);return{before:a,after:a,share:1,exact:l<this.divisor*o}}before(e,t){let i=this.first((e-t)*this.rateHz);return this.kept.slice(i,this.first(e*this.rateHz))}first(e){let[t,i]=[0,this.kept.length];for(;t<i;){let s=t+i>>1;vn(this.kept[s].frame)<e?t=s+1:i=s}return t}get latest(){return this.kept.at(-1)?.frame.timeS??NaN}complete(e,t){let[i,s]=[Math.max(e*t,this.oldest),Math.min((e+1)*t,this.newest)],r=s0*this.rateHz;for(let o=i;o<s;o+=r)if(!this.at(o/this.rateHz)?.exact)return!1;return!0}fetch(){let{focus:e}=this;if(e===void 0||this.oldest<0)return;let t=Math.max(this.divisor,Math.round(i0*this.rateHz)),i=Math.floor(Math.min(Math.max(e,this.oldest),this.newest)/t),s=performance.now(),r=l=>l*t<=this.newest&&(l+1)*t>this.oldest&&s-(this.asked.get(l)??-1/0)>r0&&!this.complete(l,t),o=this.most()>4*i0*tp?[i-1,i+1]:[],a=[i,...o].find(r);if(this.reading){if(this.reading.piece===i||this.at(e/this.rateHz)?.exact)return;this.reading.stop.abort()}a!==void 0&&(this.asked.set(a,s),this.read(a,t))}async read(e,t){let i={piece:e,stop:new AbortController};this.reading=i;let s=Math.max(e*t,this.oldest),r=Math.min((e+1)*t,this.newest),o=!0;try{let a=this.api.history.readHistory({name:this.world,view:{fields:{paths:this.fields},rateDivisor:this.divisor},firstTick:BigInt(s),lastTick:BigInt(r)},{signal:i.stop.signal}),l;for await(let c of a){if(l=c.roster??l,i.stop.signal.aborted||!l)break;this.merge(c.frames,l)}this.trouble=""}catch(a){i.stop.signal.aborted?this.asked.delete(e):o=this.failed(a)}finally{this.reading===i&&(this.reading=void 0),o&&this.fetch()}}failed(e){return e instanceof Ve&&e.code===Ae.OutOfRange?(this.look().then(()=>this.fetch()),!1):(this.trouble=Ig(e).reason==="SLOW_READER"?"":Lt(e),(tl(e)||e instanceof Ve&&e.code===Ae.ResourceExhausted)&&setTimeout(()=>this.fetch(),r0+100),!1)}merge(e,t){if(!e.length)return;let[i,s]=[vn(e[0]),vn(e[e.length-1])],r=this.first(i),o=this.first(s+1),a=e.map(l=>({frame:l,roster:t}));this.kept=[...this.kept.slice(0,r),...a,...this.kept.slice(o)],this.bound(),this.version++}bound(){let{kept:e}=this,t=this.most();if(e.length<=t)return;let i=this.focus??this.newest;i-vn(e[0].frame)>=this.newest-i?e.splice(0,e.length-t):e.splice(t)}most(){return Math.max(2*tp,Math.round(pT/Math.max(1,this.kept.at(-1)?.frame.figures.length??0)))}get count(){return this.kept.length}};var yT=8,o0=["segment_transforms","torque","torque_limits","contacts","balance","desired","status"],bT=250,a0=3e3,Fr=new Map,xT=2,Ur=class{constructor(e,t,i,s){this.api=e;this.changed=t;this.happened=i;this.framed=s}api;changed;happened;framed;people=new Map;playhead=new il;world;worlds=[];motions=[];clips=[];bodies=[];capabilities=[];flagNames=[];phase={kind:"connecting"};roster;past;watching=new AbortController;generation=0;get paused(){return this.world?.state===2}person(e){return[...this.people.values()].find(t=>t.name===e)}show(e){let t=++this.generation;this.watching.abort(),this.watching=new AbortController,this.playhead.clear(),this.people.clear(),this.past=void 0,this.roster=void 0,this.enter({kind:"connecting"}),this.keep(e,t,this.watching.signal)}end(){this.generation++,this.watching.abort(),this.playhead.clear(),this.people.clear(),this.world=void 0,this.past=void 0,this.roster=void 0}enter(e){this.phase=e,this.changed("phase")}async keep(e,t,i){let s=0;for(;t===this.generation;){try{await this.lists();let r=this.worlds.find(o=>o.name===`worlds/${e||"demo"}`)?.name??(e?void 0:this.worlds[0]?.name);if(t!==this.generation)return;if(r)await this.watch(r,i,()=>s=0);else{this.world=void 0,e?this.enter({kind:"error",text:`There is no world “${e}” on this server.`}):this.enter({kind:"empty"}),await np(1500,i);continue}}catch(r){if(t!==this.generation||i.aborted)return;if(r instanceof Ve&&r.code===Ae.NotFound&&this.phase.kind==="live")e="";else if(!tl(r)){this.enter({kind:"error",text:Lt(r)}),await np(a0,i);continue}}if(t!==this.generation)return;s++,this.playhead.clear(),this.enter({kind:"reconnecting",attempt:s}),await np(Math.min(a0,bT*2**Math.min(6,s-1)),i)}}async lists(){let[e,t,i,s]=await Promise.all([this.api.server.getServerInfo({}),this.api.worlds.listWorlds({pageSize:1e3}),this.api.motion.listClips({pageSize:1e3}),this.api.bodies.listBodies({pageSize:1e3})]);this.worlds=t.worlds,this.motions=i.clips,this.clips=i.clips.map(r=>r.name.slice(6)),this.bodies=s.bodies.map(r=>r.name.slice(7)),this.capabilities=e.capabilities,this.flagNames=e.flagNames,this.changed("lists")}async watch(e,t,i){this.world=(await this.api.worlds.getWorld({name:e},{signal:t})).world,this.past=this.world&&this.pastOf(this.world),this.past?.look(),this.changed("world");let s=(this.world?.figureCount??0)>yT,r={fields:{paths:o0},rateDivisor:s?2:1},o=new AbortController,a=()=>o.abort();t.addEventListener("abort",a,{once:!0}),this.listen(e,o.signal);let l=!1;try{for await(let{message:c}of this.api.state.watchWorld({world:e,view:r},{signal:t}))c.case==="roster"?(this.roster=c.value,await this.enroll(c.value),this.phase.kind!=="live"&&!this.people.size&&this.enter({kind:"empty"})):c.case==="frame"&&(i(),this.take(c.value),(!l||this.phase.kind!=="live")&&(l=!0,this.people.size?this.enter({kind:"live"}):this.phase.kind!=="empty"&&this.enter({kind:"empty"})))}finally{a(),t.removeEventListener("abort",a)}}async listen(e,t){try{for await(let{events:i}of this.api.state.watchEvents({world:e},{signal:t}))for(let s of i)this.world?.name===e&&this.past?.happened(s),this.happened(s)}catch{}}async enroll(e){let[t,i]=await Promise.all([this.api.figures.listFigures({parent:e.world,pageSize:1e3}),Promise.all([...new Set(e.figures.map(o=>o.body))].map(o=>this.body(o)))]),s=new Map(i.map(o=>[o.name,o])),r=new Map(this.people);this.people.clear();for(let o of e.figures){let a=s.get(o.body),l=t.figures.find(u=>u.name.endsWith(`/${o.figureId}`));if(!a||!l)continue;let c=r.get(o.figureIndex);c&&c.name===o.figureId&&c.body===a?(c.figure=l,this.people.set(o.figureIndex,c)):this.people.set(o.figureIndex,new Ks(o.figureIndex,o.figureId,a,l))}this.changed("roster")}pastOf(e){let t=`${e.name} ${e.createTime?.seconds} ${e.createTime?.nanos}`,i=Fr.get(t)??new nu(this.api,e.name,o0);Fr.delete(t),Fr.set(t,i);for(let s of Fr.keys())Fr.size>xT&&Fr.delete(s);return i}async roles(){let{roles:e}=await this.api.access.getCaller({world:this.world?.name??""});return new Set(e)}described=new Map;body(e){let t=this.described.get(e);return t||(t=this.api.bodies.getBody({name:e,includeGeometry:!0}).then(i=>{if(!i.body)throw new Error(`the server has no description of ${e}`);return i.body}),this.described.set(e,t),t.catch(()=>this.described.delete(e))),t}take(e){let t=this.playhead.newest();this.playhead.push(e),this.roster&&this.past?.add(e,this.roster);for(let i of e.figures)this.people.get(i.figureIndex)?.take(i,e.timeS);t?.tick!==e.tick&&this.framed(e)}async refresh(){if(!this.world)return;let{figures:e}=await this.api.figures.listFigures({parent:this.world.name,pageSize:1e3});for(let t of this.people.values())t.figure=e.find(i=>i.name.endsWith(`/${t.name}`))??t.figure;this.changed("roster")}async setPaused(e){if(!this.world)return;let{name:t}=this.world,i=e?await this.api.worlds.pauseWorld({name:t}):await this.api.worlds.resumeWorld({name:t});this.world=i.world,this.changed("world")}async step(){this.world&&(this.paused||await this.setPaused(!0),await this.api.worlds.stepWorld({name:this.world.name,tickCount:1}))}async setSpeed(e){this.world&&(this.world=(await this.api.worlds.setWorldSpeed({name:this.world.name,speed:e})).world,this.changed("world"))}says(e,t){let i=this.flagNames.indexOf(t);return i>=0&&(e.flags>>>i&1)===1}async carry(e,t){if(!this.world)return;let i=this.world.name;await Promise.all(e.map(async s=>{if(await this.api.perturbations.clearPerturbations({figure:s.figure.name}),t<=0)return;let r=a=>({figureId:s.name,kind:{case:"load",value:a}}),o=s.holdsCrate()?[r({segment:"l_hand",secondSegment:"r_hand",massKg:t})]:[r({segment:"l_hand",massKg:t/2}),r({segment:"r_hand",massKg:t/2})];await this.api.perturbations.applyPerturbations({world:i,perturbations:o})}))}async restart(e){let{clip:t}=e;await this.api.figures.resetFigure({name:e.figure.name}),t&&await this.api.motion.playClip({figure:e.figure.name,clip:t,loop:!0,reset:!0,placement:e.figure.placement})}async standUp(e){let t=e.loadKg();await this.restart(e),t>0&&await this.carry([e],t),await this.tickIfPaused()}async tickIfPaused(){if(!(!this.world||!this.paused))try{await this.api.worlds.stepWorld({name:this.world.name,tickCount:1})}catch(e){if(!(e instanceof Ve&&e.code===Ae.FailedPrecondition))throw e}}async reset(){if(!this.world)return[];let{name:e}=this.world,t=!this.paused;t&&await this.api.worlds.pauseWorld({name:e});try{let i=[...this.people.values()],s=await Promise.allSettled(i.map(r=>this.restart(r)));return await this.tickIfPaused(),s.flatMap((r,o)=>r.status==="rejected"?[`${i[o].name} (${Lt(r.reason)})`]:[])}finally{t&&await this.api.worlds.resumeWorld({name:e})}}};function np(n,e){return new Promise(t=>{let i=setTimeout(t,n);e.addEventListener("abort",()=>{clearTimeout(i),t()})})}var iu=class{constructor(e,t,i){this.parts=t;this.wishes=i;this.session=new Ur(e,r=>{r==="roster"&&(this.populated=void 0),(r==="world"||r==="phase")&&this.clock();let{world:o,phase:a}=this.session,l=r==="world"&&o&&o.name!==`worlds/${this.world}`;this.open&&(l||a.kind==="error")&&this.wishes.gone()},()=>{},r=>{this.session.world&&this.obstacles.follow(e,this.session.world.name,r)}),this.people=new js(this.session),this.labels=new Js(t.labels),this.load=new Qs(t.slider,t.output,this.session,{change:()=>{},done:()=>{},failed:r=>i.say(Lt(r),!0)});let s=r=>{r.catch(o=>i.say(Lt(o),!0))};t.pause.addEventListener("click",()=>s(this.session.setPaused(!this.session.paused))),t.push.addEventListener("click",()=>i.push(this.session))}parts;wishes;session;scene;labels;load;obstacles=new Nr;people;populated;dark=!1;open=!1;world="";clock(){this.parts.pause.textContent=this.session.paused?"Resume":"Pause",this.parts.pause.setAttribute("aria-pressed",String(this.session.paused)),this.parts.pause.disabled=this.parts.push.disabled=this.session.phase.kind!=="live",this.load.enable(this.session.phase.kind==="live")}show(e){this.open=!0,this.world=e,this.parts.pane.hidden=!1;try{this.scene??=this.make()}catch{this.parts.canvas.hidden=!0}this.scene?.theme(this.dark),this.session.show(e)}make(){let e=new Lr(this.parts.canvas,{choose:t=>t&&this.wishes.choose(t.name),pushing:(t,i,s)=>this.labels.push=t?{text:`${t.impulse.length().toFixed(0)} N·s`,x:i,y:s}:void 0,push:t=>this.wishes.drawn(this.session,t),following:()=>{}});return e.add(this.obstacles.group),e}close(){this.open=!1,this.parts.pane.hidden=!0,this.session.end()}theme(e){this.dark=e,this.open&&this.scene?.theme(e)}live(e){let{session:t}=this,i=t.playhead.at(e,t.paused?1:t.world?.speed??1);return i&&{...i,time:ao(i),people:t.people,exact:!0}}past(e,t){return this.people.at(e,t)}draw(e,t,i,s,r){let{scene:o}=this;if(!o)return;e&&e.people!==this.populated&&(o.populate(e.people.values()),this.populated=e.people),r?s.takeView(o):o.takeView(s);let a=[...e?.people.values()??[]];o.prepare(e&&{before:Hi(e.before),after:Hi(e.after),share:e.share},t,a.find(l=>l.name===i)),e&&this.obstacles.place(e.before,e.after,e.share),this.labels.update(this.session.phase.kind==="live"?a:[],i,o),o.draw3d()}read(){this.load.read()}};var[vT,ST]=[.3,4];function l0(n){return[[5,"owner"],[4,"director"],[3,"driver"],[2,"perturber"],[1,"viewer"]].find(([t])=>n.has(t))?.[1]??"none"}function c0(n){if(!n.has(4))return`Only a director can rewind this world; your role is ${l0(n)}. The time line shows you its past.`}function u0(n){return n.has(4)?n.has(7)?void 0:"A branch is a new world, and you may not create worlds here.":`Only a director can branch this world; your role is ${l0(n)}.`}async function d0(n,e,t){let i=n.world?.name??"",{world:s}=await n.api.checkpoints.forkWorld({source:{case:"world",value:i},worldId:t,paused:!0,tick:e===void 0?void 0:BigInt(e)});if(!s)throw new Error("the server has made no world");let r=o=>o.slice(7);return{original:r(i),branch:r(s.name),since:Number(s.tick)}}var su=class{constructor(e){this.say=e}say;speed;get running(){return this.speed!==void 0}async begin(e){if(!this.running){this.speed=e.world?.speed??1;try{e.paused&&await e.setPaused(!1),await e.setSpeed(ST)}catch(t){this.speed=void 0,this.say(Lt(t),!0)}}}update(e,t){if(this.speed===void 0||t>vT)return;let i=this.speed;this.speed=void 0,e.setSpeed(i).catch(s=>this.say(Lt(s),!0))}};var _T=4,ip=2.5,ET=.25,ru=class{constructor(e){this.list=e;this.told.className="hidden",this.told.setAttribute("aria-live","polite"),e.removeAttribute("aria-live"),e.after(this.told)}list;shown=new Map;told=document.createElement("div");last="";event(e,t){let i=Ug(e);i&&(this.shown.delete(`event ${e.figureId}`),this.shown.set(`event ${e.figureId}`,{...i,until:t+2*ip}),this.told.textContent=i.text)}say(e,t,i=!1){this.shown.delete("page"),this.shown.set("page",{text:e,grave:i,until:t+2.4*ip}),this.told.textContent=e}clear(){this.shown.clear()}update(e,t,i){for(let o of e){let a=new Map;o.body.dofs.forEach((c,u)=>{let h=o.limitSince[u];Number.isNaN(h)||a.set(c.joint,Math.max(a.get(c.joint)??0,t-h))});let l=new Map;for(let[c,u]of a){if(u<ET)continue;let{name:h}=o.body.joints[c],p=h.replace(/^[lr]_/,""),d=l.get(p)??{sides:[],seconds:0};l.set(p,{sides:[...d.sides,h],seconds:Math.max(d.seconds,u)})}for(let[c,{sides:u,seconds:h}]of l){let p=u.length>1?`both ${nl(c)}s at their torque limit`:`${nl(u[0])} at its torque limit`;this.shown.set(`${o.name} ${c}`,{text:`${o.name}: ${p} for ${h.toFixed(1)} s`,grave:!1,until:i+ip})}}for(let[o,a]of this.shown)a.until<i&&this.shown.delete(o);let s=[...this.shown.values()].sort((o,a)=>Number(a.grave)-Number(o.grave)||a.until-o.until).slice(0,_T),r=s.map(o=>`${o.grave?"!":""}${o.text}`).join(`
`);r!==this.last&&(this.last=r,this.list.replaceChildren(...s.map(o=>{let a=document.createElement("li");return a.textContent=o.text,o.grave&&(a.className="grave"),a})))}};var sp=3,h0="no torque to plot",AT=4,m0=[-8,-6,-4,-2,0];function MT(n,e){let t=Math.max(e-n,AT),i=10**Math.floor(Math.log10(t/4)),s=[1,2,5,10].map(a=>a*i).find(a=>t/a<=4)??10*i,r=Math.floor(n/s)*s,o=Math.ceil(e/s)*s;return{low:r,high:o>r?o:r+s,step:s}}function RT(n,e,t){return n&&e>=n.low&&t<=n.high&&t-e>=.5*(n.high-n.low-n.step)?n:MT(e,t)}var p0=.95;function f0(n,e){let t=[...n].sort((i,s)=>i-s);return t[Math.min(t.length-1,Math.floor(e*t.length))]??0}function g0(n){return Array.from({length:Math.round((n.high-n.low)/n.step)+1},(e,t)=>n.low+t*n.step)}function Pr(n,e,...t){let i=document.createElement(n);return i.className=e,i.append(...t),i}var ou=class{figure=Pr("figure","plot");name=document.createElement("span");value=document.createElement("span");canvas=document.createElement("canvas");torques=Pr("div","torques");axis;dof=-1;person;constructor(){this.canvas.setAttribute("role","img"),this.canvas.setAttribute("aria-label",h0),this.canvas.tabIndex=-1,this.torques.setAttribute("aria-hidden","true");let e=Pr("div","times",...m0.map(s=>Pr("span","",s===0?"0 s":wi(s))));e.setAttribute("aria-hidden","true");let t=Pr("span","unit","N·m");t.setAttribute("aria-hidden","true");let i=document.createElement("figcaption");i.append(this.name,this.value),this.figure.append(i,this.torques,this.canvas,t,e)}show(e,t,i){(e!==this.person||t!==this.dof)&&([this.person,this.dof,this.axis]=[e,t??-1,void 0],i=!0);let s=t===void 0?void 0:e?.history.at(-1);if(!e||t===void 0||!s){this.name.textContent=this.value.textContent="",this.torques.replaceChildren(),this.canvas.setAttribute("aria-label",h0),this.canvas.getContext("2d")?.clearRect(0,0,this.canvas.width,this.canvas.height);return}let r=e.body.dofs.length,{history:o}=e,a=o.map(p=>p.torque[t]),l=Math.min(0,...a,f0(o.map(p=>p.limits[t]),1-p0)),c=Math.max(0,...a,f0(o.map(p=>p.limits[r+t]),p0)),u=RT(this.axis,l,c);if(u!==this.axis){this.axis=u;let p=d=>100*(u.high-d)/(u.high-u.low);this.torques.replaceChildren(...g0(u).map(d=>{let f=Pr("span","",wi(d));return f.style.top=`${p(d).toFixed(2)}%`,f}))}if(wT(this.canvas,e,t,u),!i)return;this.name.textContent=ti(e.body.dofs[t].name);let h=`${wi(s.limits[t])} to ${wi(s.limits[r+t])}`;this.value.textContent=`${wi(s.torque[t])} N·m (${h})`,this.canvas.setAttribute("aria-label",TT(e,t))}};function wT(n,e,t,i){let s=Math.min(2,devicePixelRatio),[r,o]=[n.clientWidth,n.clientHeight];if(!r||!o)return;n.width!==Math.round(r*s)&&(n.width=Math.round(r*s)),n.height!==Math.round(o*s)&&(n.height=Math.round(o*s));let a=n.getContext("2d"),{history:l}=e,c=l.at(-1);if(!a||!c)return;let u=getComputedStyle(n),h=A=>u.getPropertyValue(A);a.setTransform(s,0,0,s,0,0),a.clearRect(0,0,r,o);let p=e.body.dofs.length,d=A=>r-(c.time-A)/qs*r,f=A=>1+(i.high-A)/(i.high-i.low)*(o-2),b=A=>{a.beginPath(),l.forEach((_,w)=>w?a.lineTo(d(_.time),f(A(_))):a.moveTo(d(_.time),f(A(_))))},g=A=>A.limits[t],m=A=>A.limits[p+t];b(m);for(let A=l.length-1;A>=0;A--)a.lineTo(d(l[A].time),f(g(l[A])));a.closePath(),a.fillStyle=h("--band"),a.fill(),a.lineWidth=1;for(let A of g0(i))a.strokeStyle=h(Math.abs(A)<1e-9?"--quiet":"--grid"),a.beginPath(),a.moveTo(0,f(A)),a.lineTo(r,f(A)),a.stroke();a.strokeStyle=h("--grid");for(let A of m0.slice(1,-1))a.beginPath(),a.moveTo(d(c.time+A),0),a.lineTo(d(c.time+A),o),a.stroke();a.lineJoin="round",a.strokeStyle=h("--accent"),a.lineWidth=1.6,b(A=>A.torque[t]),a.stroke(),a.strokeStyle=h("--hot"),a.lineWidth=4,a.beginPath();let S=!1;for(let A of l){let _=A.torque[t]<0?g(A):m(A),w=_!==0&&A.torque[t]/_>.995;w&&S?a.lineTo(d(A.time),f(A.torque[t])):w&&a.moveTo(d(A.time),f(A.torque[t])),S=w}a.stroke()}function y0(n,e){let t=e.filter(s=>!n.includes(s));return[...n.slice(0,e.length).map(s=>e.includes(s)?s:t.shift()).filter(s=>s!==void 0),...t]}function b0(n){let e=new Float32Array(n.body.dofs.length),t=e.length;for(let o of n.history)for(let a=0;a<t;a++){let l=o.torque[a]<0?o.limits[a]:o.limits[t+a];l!==0&&(e[a]=Math.max(e[a],o.torque[a]/l))}let i=[...e.keys()].sort((o,a)=>e[a]-e[o]),s=[],r=new Set;for(let o of i){let{joint:a}=n.body.dofs[o],l=n.body.joints[a].name.replace(/^[lr]_/,""),c=s.some(u=>n.body.joints[n.body.dofs[u].joint].name.replace(/^[lr]_/,"")===l);if(!(r.has(a)||c)&&(r.add(a),s.push(o),s.length===sp))break}return s}function TT(n,e){let t=n.history.at(-1),i=ti(n.body.dofs[e].name);if(!t)return i;let s=`${wi(t.limits[e])} to ${wi(t.limits[n.body.dofs.length+e])} N·m`;return`${i}: ${wi(t.torque[e])} N·m, available range ${s}, last ${qs} s`}function se(n,e={},...t){let i=document.createElement(n);for(let[s,r]of Object.entries(e))i.setAttribute(s,r);return i.append(...t),i}var cs=(n,e={})=>se("button",{type:"button",...e},n),Ls=(n,...e)=>se("section",{},se("h2",{},n),...e),NT=0;function un(n,e,t){return e.id||=`control-${++NT}`,se("div",{class:t?"row three":"row"},se("label",{for:e.id},n),e,...t?[t]:[])}function _i(n,e,t){let i=JSON.stringify(e);n.dataset.key!==i&&(n.dataset.key=i,n.replaceChildren(...e.map(s=>se("option",{value:s.value},s.text)))),document.activeElement!==n&&(n.value=t)}var x0=[["front","from the front",[-1,0]],["back","from behind",[1,0]],["left","from the left",[0,-1]],["right","from the right",[0,1]]];function BT(n){let[,e,t,i,s]=/^(male|female)-([\d.]+)y-(\d+)mm-(\d+)g$/.exec(n)??[];return e?`${e==="male"?"man":"woman"}, ${t} y, ${(Number(i)/1e3).toFixed(2)} m, ${(Number(s)/1e3).toFixed(0)} kg`:n.replaceAll("-"," ")}var LT=[[1,"with safeguards"],[2,"as published in 2000"]],v0=[[0,"off"],[1,"real time"],[10,"10 times faster"],[60,"60 times faster"]],rp=[["state","State"],["margin","Balance margin"],["load","Load"],["error","Tracking error"],["effort","Highest effort"]],au=class{constructor(e,t,i,s){this.session=t;this.wishes=i;this.shown=s;_i(this.direction,x0.map(([d,f])=>({value:d,text:f})),"front"),_i(this.target,["chest","pelvis","head","r_hand","l_foot"].map(d=>({value:d,text:ti(d)})),"chest");let r=cs("Open BVH…",{id:"open"});r.addEventListener("click",()=>this.file.click()),this.file.addEventListener("change",()=>{let[d]=this.file.files??[];d&&this.wishes.open(d),this.file.value=""});let o=cs("Push",{id:"push",class:"main"});o.addEventListener("click",()=>this.wishes.forChosen(d=>this.push(d)));let a=cs("Stand up",{id:"stand",title:"Puts the figure back on its feet and starts its clip again (U)"});a.addEventListener("click",()=>this.wishes.forChosen(d=>this.session.standUp(d)));let l=cs("Add figure",{id:"add"});l.addEventListener("click",()=>this.wishes.add());let c=cs("Remove",{id:"remove"});c.addEventListener("click",()=>this.wishes.forChosen(async d=>{await this.session.api.figures.deleteFigure({name:d.figure.name})})),this.clip.addEventListener("change",()=>this.wishes.play(this.clip.value)),this.body.addEventListener("change",()=>this.wishes.rebuild({body:this.body.value})),_i(this.sex,[{value:String(2),text:"woman"},{value:String(1),text:"man"}],String(2));let u=cs("Apply",{id:"make-body"});u.addEventListener("click",()=>{let d=f=>Number.isFinite(f.valueAsNumber)?f.valueAsNumber:0;this.wishes.rebuild({profile:{sex:Number(this.sex.value),ageYears:d(this.age),heightM:d(this.height),massKg:d(this.mass)}})}),this.presetRow.hidden=!0,this.changes(this.preset,"paper",d=>({paper:{preset:d}})),this.changes(this.fatigue,"fatigue_time_scale",d=>({fatigueTimeScale:d})),this.stepper.addEventListener("change",()=>this.wishes.rebuild({stepper:Number(this.stepper.value)})),this.changes(this.controller,"controller",d=>({controller:d})),this.strength.addEventListener("input",()=>this.strengthOut.textContent=`${Math.round(Number(this.strength.value)*100)} %`),this.changes(this.strength,"strength",(d,f)=>{let{dofs:b,percentile:g,effort:m}=f.figure.strength??{};return{strength:{all:d,dofs:b,percentile:g,effort:m}}}),this.assist.addEventListener("input",()=>this.assistOut.textContent=`${Math.round(Number(this.assist.value)*100)} %`),this.changes(this.assist,"assist",d=>({assist:d})),this.impulse.addEventListener("input",()=>this.impulseOut.textContent=`${this.impulse.value} N·s`),this.ofChosen=[o,a,c,u];let h=["python","cli","link"].map(d=>{let f=cs({python:"Copy as Python",cli:"Copy command line",link:"Copy link"}[d],{id:`copy-${d}`});return f.addEventListener("click",()=>this.wishes.copy(d)),f}),p=[["ghost","Desired motion"],["effort","Joint effort"],["forces","Contact forces"],["support","Support and balance"]].map(([d,f])=>{let b=se("input",{type:"checkbox",id:`show-${d}`});return b.checked=this.shown[d],b.addEventListener("change",()=>{this.shown[d]=b.checked,this.wishes.shown()}),se("label",{},b,f)});e.append(Ls("Figures",this.figures,this.summary,se("div",{class:"buttons"},a,l,c)),Ls("Motion",un("Clip",this.clip),se("div",{class:"buttons"},r,this.file),this.report),Ls("Joint torques",un("Joint",this.dofs),se("ul",{class:"key","aria-label":"Curves"},...[["torque","torque"],["range","available range"],["reached","at its limit"]].map(([d,f])=>se("li",{},se("i",{class:d}),f))),...this.plots.map(d=>d.figure)),Ls("Push",un("Impulse",this.impulse,this.impulseOut),un("Direction",this.direction),un("Body part",this.target),se("div",{class:"buttons"},o)),Ls("Body and control",un("Body",this.body),se("details",{},se("summary",{},"Custom body"),un("Sex",this.sex),un("Age (years)",this.age),un("Height (m)",this.height),un("Mass (kg)",this.mass),se("div",{class:"buttons"},u)),un("Strength",this.strength,this.strengthOut),un("Fatigue",this.fatigue),un("Controller",this.controller),this.presetRow,un("Stepper",this.stepper),un("Assist",this.assist,this.assistOut)),Ls("Display",se("div",{class:"checks"},...p),se("ul",{class:"key","aria-label":"Legend"},...[["com","centre of mass"],["zmp","zero-moment point (ZMP)"],["area","support polygon"],["force","contact force"],["limit","at the torque limit"]].map(([d,f])=>se("li",{},se("i",{class:d}),f)))),Ls("Export",se("div",{class:"buttons"},...h)))}session;wishes;shown;figures=se("div",{id:"figures",role:"group","aria-label":"Figures"});facts=Object.fromEntries(rp.map(([e])=>[e,se("dd",{"data-fact":e})]));meter=se("i");summary=se("div",{id:"summary"},se("dl",{},...rp.flatMap(([e,t])=>[se("dt",{},t),this.facts[e]])),se("span",{class:"meter","aria-hidden":"true"},this.meter));clip=se("select",{id:"clip"});body=se("select",{id:"body"});controller=se("select",{id:"controller"});preset=se("select",{id:"preset"});presetRow=un("Variant",this.preset);stepper=se("select",{id:"stepper"});fatigue=se("select",{id:"fatigue"});sex=se("select",{id:"sex"});age=se("input",{id:"age",type:"number",min:"6",max:"90",step:"1",value:"70"});height=se("input",{id:"height",type:"number",min:"0.8",max:"2.1",step:"0.01",placeholder:"average"});mass=se("input",{id:"mass",type:"number",min:"12",max:"180",step:"0.5",placeholder:"average"});strength=se("input",{id:"strength",type:"range",min:"0.2",max:"2",step:"0.05",value:"1"});strengthOut=se("output",{for:"strength"},"100 %");assist=se("input",{id:"assist",type:"range",min:"0",max:"1",step:"0.05",value:"0"});assistOut=se("output",{for:"assist"},"0 %");impulse=se("input",{id:"impulse",type:"range",min:"5",max:"150",step:"5",value:"30"});impulseOut=se("output",{for:"impulse"},"30 N·s");direction=se("select",{id:"direction"});target=se("select",{id:"target"});file=se("input",{type:"file",accept:".bvh",class:"hidden",tabindex:"-1","aria-label":"BVH file"});report=se("div",{id:"report","aria-live":"polite"});plots=Array.from({length:sp},()=>new ou);dofs=se("select",{id:"plotted"});ofChosen;busiest=[];busiestAt=0;seen;view(e){e!==this.seen&&(this.seen=e,this.busiestAt=0)}push(e,t=this.session){if(!t.world)return Promise.resolve();let i=Number(this.impulse.value),[s,r]=x0.find(([l])=>l===this.direction.value)?.[2]??[1,0],o=e.figure.placement?.yawRad??0,a={x:i*(s*Math.cos(o)-r*Math.sin(o)),y:i*(s*Math.sin(o)+r*Math.cos(o)),z:0};return t.api.perturbations.applyPerturbations({world:t.world.name,perturbations:[{figureId:e.name,kind:{case:"impulse",value:{segment:this.target.value,impulseNewtonSeconds:a,durationS:.1}}}]}).then(()=>this.wishes.say(`Pushed ${e.name} ${this.direction.selectedOptions[0]?.text??""}: ${i} N·s`))}changes(e,t,i){e.addEventListener("change",()=>{let s=Number(e.value);this.wishes.forChosen(r=>this.change(r,i(s,r),t))})}async change(e,t,i){let{figure:s}=await this.session.api.figures.updateFigure({figure:{name:e.figure.name,...t},updateMask:{paths:[i]}});s&&(e.figure=s),this.lists(e),this.wishes.shown()}lists(e){let t=[...this.session.people.values()],i=document.activeElement instanceof HTMLElement?document.activeElement.dataset.figure:void 0;this.figures.replaceChildren(...t.map(d=>{let f=cs(d.name,{"aria-pressed":String(d===e),"data-figure":d.name});return f.addEventListener("click",()=>this.wishes.choose(d)),f})),i&&[...this.figures.children].find(d=>d instanceof HTMLElement&&d.dataset.figure===i)?.focus();let s=d=>({value:d,text:BT(d)}),r=e?.clip.slice(6)??"";_i(this.clip,[...r?[]:[{value:"",text:e?.figure.status?.driverId?"driven live":"none (holds still)"}],...this.session.clips.map(s)],r),_i(this.body,[...new Set([...this.session.bodies,...e?[e.body.name.slice(7)]:[]])].map(s),e?.body.name.slice(7)??"");let o=d=>!this.session.capabilities.length||this.session.capabilities.includes(d),a=[[2,"modern","CONTROLLER_MODERN"],[1,"paper 2000","CONTROLLER_PAPER"],[3,"motors only","CONTROLLER_MOTORS"]];_i(this.controller,a.filter(d=>o(d[2])).map(([d,f])=>({value:String(d),text:f})),String(e?.figure.controller||2)),_i(this.preset,LT.map(([d,f])=>({value:String(d),text:f})),String(e?.figure.paper?.preset||1)),this.presetRow.hidden=e?.figure.controller!==1;let l=e?.figure.fatigueTimeScale??0;_i(this.fatigue,[...v0,...v0.some(([d])=>d===l)?[]:[[l,`${l} times faster`]]].map(([d,f])=>({value:String(d),text:f})),String(l));let c=[[1,"torque","STEPPER_TORQUE"],[2,"kinematic","STEPPER_KINEMATIC"]];_i(this.stepper,c.filter(d=>o(d[2])).map(([d,f])=>({value:String(d),text:f})),String(e?.figure.stepper||1));let u=e?.figure.strength?.all||1;document.activeElement!==this.strength&&(this.strength.value=String(u)),this.strengthOut.textContent=`${Math.round(u*100)} %`;let h=e?.figure.assist??0;document.activeElement!==this.assist&&(this.assist.value=String(h)),this.assistOut.textContent=`${Math.round(h*100)} %`;let p=e?.body.dofs??[];_i(this.dofs,[{value:"",text:"highest effort"},...p.map(d=>({value:d.name,text:ti(d.name)}))],this.dofs.value);for(let d of[this.clip,this.body,this.controller,this.preset,this.stepper,this.fatigue,this.sex,this.age,this.height,this.mass,...this.ofChosen,this.strength,this.assist,this.dofs])d.disabled=!e;this.busiestAt=0}describe(e){let t=o=>this.session.says(e,o),i=e.hardest(),s=e.loadKg(),r=(e.frame?.status?.trackingJointRmsRad??0)*180/Math.PI;return{state:Pg(t),margin:t("FALLEN")||t("FLIGHT")?"–":Dg(e.frame?.balance?.marginM),load:s>0?Zi(s):"none",error:`${r.toFixed(1)}° rms`,effort:`${Math.round(100*e.used[i])} % ${ti(e.body.dofs[i]?.name??"")}`}}update(e,t){let i=this.seen;if(t){let o=i&&this.describe(i);for(let[l]of rp){let c=o?.[l]??"–";this.facts[l].textContent!==c&&(this.facts[l].title=this.facts[l].textContent=c)}let a=i?.used[i.hardest()]??0;this.meter.className=a>.995?"hot":"",this.meter.style.width=`${Math.round(a*100)}%`}i&&e-this.busiestAt>3&&(this.busiest=y0(this.busiest,b0(i)),this.busiestAt=e);let s=i&&this.dofs.value?i.body.dofs.findIndex(o=>o.name===this.dofs.value):-1,r=s>=0?[s]:this.busiest;this.plots.forEach((o,a)=>{o.figure.hidden=s>=0&&a>0,o.figure.hidden||o.show(i,r[a],t)})}showReport(e,t,i,s){if(i!==void 0){this.report.replaceChildren(se("div",{class:"report bad",role:"alert"},se("strong",{},`${e} could not be read`),se("p",{},i)));return}let r=t;if(!r)return;let o=Gg(r);s&&o.push(Fg(s));let a=Vg(r),l=a.length?[se("strong",{class:"warnings"},a.length===1?"1 warning":`${a.length} warnings`),se("ul",{class:"warnings"},...a.map(d=>se("li",{},d)))]:[],c=[...r.clamped].sort((d,f)=>f.maxExcessRad-d.maxExcessRad).map(d=>se("tr",{},...Md(d).map(f=>se("td",{},f)))),u=se("tr",{},...["Angle","Frames","Excess"].map(d=>se("th",{scope:"col"},d))),h=c.length?[se("details",{},se("summary",{},c.length===1?"1 angle limited to the body’s range":`${c.length} angles limited to the body’s range`),se("table",{},u,...c))]:[],p=se("details",{},se("summary",{},"Bone mapping"),se("ul",{},...r.mapped.map(d=>se("li",{},`${d.bone}: ${d.joints.join(", ")}`))));this.report.replaceChildren(se("div",{class:"report"},se("strong",{},`${e} is playing`),se("ul",{},...o.map(d=>se("li",{},d))),...l,...h,p))}};var op=1,lu=class{constructor(e,t,i,s){this.session=e;this.beside=t;this.parts=i;this.wishes=s;this.catching=new su(s.say),i.catchUp.addEventListener("click",()=>{this.catching.begin(this.branch)}),i.swap.addEventListener("click",()=>this.swap()),i.done.addEventListener("click",()=>this.ask())}session;beside;parts;wishes;pair;mainIsBranch=!0;catching;get branch(){return this.mainIsBranch?this.session:this.beside.session}get original(){return this.mainIsBranch?this.beside.session:this.session}begin(e){this.pair=e,this.mainIsBranch=!0,this.open()}open(){let{pair:e}=this;if(!e)return;let{strip:t,mainHeader:i,mainTitle:s,besideTitle:r}=this.parts;t.hidden=i.hidden=!1;let o=[`Branch: ${e.branch}`,`Original: ${e.original}`];[s.textContent,r.textContent]=this.mainIsBranch?o:o.reverse(),document.body.dataset.pair=this.mainIsBranch?"branch":"original",this.wishes.show(this.mainIsBranch?e.branch:e.original),this.beside.show(this.mainIsBranch?e.original:e.branch),this.wishes.changed()}swap(){this.mainIsBranch=!this.mainIsBranch,this.open()}leave(){this.pair&&(this.pair=void 0,this.parts.strip.hidden=this.parts.mainHeader.hidden=!0,delete document.body.dataset.pair,this.beside.close(),this.wishes.changed())}ask(){let{pair:e}=this;if(!e)return;let t=(r,o,a)=>{let l=se("button",{type:"button",...o},r);return l.addEventListener("click",()=>{s(),a()}),l},i=()=>{this.leave(),this.wishes.show(e.original)},s=this.wishes.ask("End the comparison",se("p",{},`The branch “${e.branch}” is a world of its own and goes on until it is deleted.`),se("div",{class:"buttons"},t("Delete the branch",{id:"branch-delete",class:"main"},()=>{i(),this.session.api.worlds.deleteWorld({name:`worlds/${e.branch}`}).then(()=>this.wishes.say(`The branch “${e.branch}” is deleted`),r=>this.wishes.say(Lt(r),!0))}),t("Keep it",{id:"branch-keep"},i)))}time(e,t){return this.pair&&(this.mainIsBranch?e:t)?.time}update(e){let{pair:t,parts:i}=this;if(!t)return;let s=this.branch.past?.rateHz??this.original.past?.rateHz??60,r=e===void 0?NaN:e-t.since/s,a=(this.original.playhead.newest()?.timeS??NaN)-(this.branch.playhead.newest()?.timeS??NaN);this.catching.update(this.branch,a);let l=Number.isNaN(r)?"Connecting":`Since the branch: ${Math.max(0,r).toFixed(1)} s`;i.since.textContent!==l&&(i.since.textContent=l);let c=this.words(a);i.lag.textContent!==c&&(i.lag.textContent=c),i.catchUp.disabled=!(a>op)||this.catching.running}words(e){return this.catching.running?`Catching up: ${Math.max(0,e).toFixed(1)} s to go`:this.branch.paused?"The branch is paused: change something in it, then resume it.":e>op?`The original is shown ${e.toFixed(1)} s after it happened.`:e<-op?"The original is behind the branch: its newest picture is shown.":"Both are live."}};var FT=3,UT=.2,cu=class{constructor(e,t){this.root=e;this.standUp=t;this.root.setAttribute("role","status"),this.root.append(this.list,this.note),this.root.hidden=!0}root;standUp;list=document.createElement("ul");note=document.createElement("p");rows=new Map;lying=new Set;update(e,t,i){let s=new Set;for(let c of e)t(c)&&(this.lying.has(c.name)||PT(c))&&s.add(c.name);this.lying=s;let r=[...s].sort((c,u)=>+(u===i?.name)-+(c===i?.name)).slice(0,FT);for(let[c,u]of this.rows)r.includes(c)||(u.remove(),this.rows.delete(c));for(let c of r)this.rows.has(c)||this.add(c);for(let[c,u]of this.rows)u.classList.toggle("chosen",c===i?.name);let o=s.size-r.length,a=s.size===1?"It gets up by itself only if its motion gets up.":"They get up by themselves only if their motions get up.",l=o>0?`${o} more ${o===1?"figure has":"figures have"} fallen. Reset puts all of them back on their feet.`:a;this.note.textContent!==l&&(this.note.textContent=l),this.root.hidden=!s.size}add(e){let t=document.createElement("li"),i=document.createElement("span");i.textContent=`${e} has fallen`;let s=document.createElement("button");s.type="button",s.textContent="Stand up again",s.setAttribute("aria-label",`Stand ${e} up again`),s.addEventListener("click",()=>this.standUp(e));let r=document.createElement("kbd");r.textContent="U",r.setAttribute("aria-hidden","true"),s.append(" ",r),t.append(i,s),this.rows.set(e,t),this.list.append(t)}};function PT(n){let e=Tt(n.frame?.desired?.rootPose),t=Tt(n.frame?.segmentTransforms);return e.length<3||t.length<3||e[2]>t[2]+UT}var ap=n=>n.split("/").at(-1)??n,DT=n=>(io[n]??"MODERN").toLowerCase(),GT=n=>n.strength?.all||1,Fs=n=>Number(n.toFixed(3));function uu(n){let e=n.figure;return{id:n.name,body:ap(n.body.name),controller:DT(e.controller),strength:Fs(GT(e)),clip:ap(n.clip),x:Fs(e.placement?.xM??0),y:Fs(e.placement?.yM??0),stepper:e.stepper===2?"kinematic":"",assist:Fs(e.assist),preset:e.paper?.preset===2?"2000":"",fatigue:Fs(e.fatigueTimeScale)}}function _0(n){let e=new URLSearchParams;n.world&&e.set("world",n.world),n.figure&&e.set("figure",n.figure),n.load!==void 0&&e.set("load",String(n.load)),n.hide.length&&e.set("hide",n.hide.join(".")),n.camera&&e.set("camera",n.camera.join("_")),n.follow&&e.set("follow","1"),n.beside&&e.set("beside",n.beside),n.beside&&e.set("since",String(n.since));for(let t of n.figures)e.append("f",[t.id,t.body,t.controller,t.strength,t.clip,t.x,t.y,t.stepper,t.assist||"",t.preset,t.fatigue||""].join("~").replace(/~+$/,""));return e.toString()}var S0=/^[a-z][a-z0-9-]{0,62}$/;function lp(n){let e=new URLSearchParams(n.replace(/^#/,"")),t=o=>{let a=e.get(o)??"";return S0.test(a)?a:""},i=e.has("load")?Number(e.get("load")):void 0,s=e.get("camera")?.split("_").map(Number),r=e.getAll("f").slice(0,64).flatMap(o=>{let[a,l,c,u,h,p,d,f,b,g,m]=o.split("~"),[S,A,_,w,R]=[Number(u),Number(p),Number(d),Number(b||0),Number(m||0)];return!S0.test(a)||!l||![S,A,_,w,R].every(Number.isFinite)?[]:[{id:a,body:l,controller:c??"",strength:S,clip:h??"",x:A,y:_,stepper:f??"",assist:w,preset:g??"",fatigue:R}]});return{world:t("world"),figure:t("figure"),load:i!==void 0&&i>=0&&i<=20?i:void 0,hide:(e.get("hide")??"").split(".").filter(Boolean),camera:s?.every(Number.isFinite)?s:void 0,follow:e.get("follow")==="1",figures:r,beside:t("beside"),since:Math.max(0,Math.trunc(Number(e.get("since")??0))||0)}}function VT(n){let e=io[n.toUpperCase()];return typeof e=="number"?e:0}function OT(n){return n==="kinematic"?2:0}function E0(n){return{body:`bodies/${n.body}`,controller:VT(n.controller),strength:{all:n.strength},stepper:OT(n.stepper),assist:n.assist,fatigueTimeScale:n.fatigue,paper:n.preset==="2000"?{preset:2}:void 0,placement:{xM:n.x,yM:n.y}}}function kT(n){if(!n)return"";let e=n.metric===3?"H2":n.metric===2?"H":"I",t=n.priority===2?"nested":"paper",i=n.share===2?"balanced":"paper",s={"to-limit":n.toLimit,tilt:n.tilt,"zmp-feasible":n.zmpFeasible,"track-hands":n.trackHands,"track-com":n.trackCom,"hand-over":n.handOver},r=Object.entries(s).map(([o,a])=>`--${o}=${!!a}`);return[`--alpha ${n.alpha??0} --horizon ${n.horizonS??0} --metric ${e} --priority ${t} --share ${i}`,...r].join(" ")}function WT(n,e){let t=e.find(s=>ap(s.name)===n);if(!n||!t||t.builtin)return`builtin:${n||"idle"}`;let i=t.displayName||`${n}.bvh`;return/^[\w.-]+$/.test(i)?i:`'${i.replaceAll("'","'\\''")}'`}function A0(n,e){let t=uu(n),i=[`sinew run ${WT(t.clip,e)} --body ${t.body} --controller ${t.controller}`];t.stepper&&i.push(`--stepper ${t.stepper}`),t.preset&&i.push(kT(n.figure.paper)),t.strength!==1&&i.push(`--strength ${t.strength}`),t.assist&&i.push(`--assist ${t.assist}`),t.fatigue&&i.push(`--fatigue ${t.fatigue}`);for(let s of n.loads())i.push(`--load ${Fs(s.massKg)}@${s.segments.join("+")}`);return i.join(" ")}function M0(n,e,t,i){let s=JSON.stringify,r=["import sinew","",`with sinew.Client(${s(n)}) as client, client.create_world(paused=True) as world:`];for(let a of e){let l=uu(a),c=l.id.replaceAll("-","_"),u=[`body=${s(l.body)}`,`controller=${s(l.controller)}`,`position=(${l.x}, ${l.y})`];l.strength!==1&&u.push(`strength=${l.strength}`),l.assist&&u.push(`assist=${l.assist}`),l.stepper&&u.push(`stepper=${s(l.stepper)}`),l.preset&&u.push(`paper=sinew.Paper(preset=${s(l.preset)})`),l.fatigue&&u.push(`fatigue_time_scale=${l.fatigue}`),r.push(`    ${c} = world.add_figure(${s(l.id)}, ${u.join(", ")})`),l.clip&&r.push(`    ${c}.play(${s(l.clip)}, loop=True, reset=True, position=(${l.x}, ${l.y}))`);for(let h of a.loads())r.push(`    ${c}.carry(${[Fs(h.massKg),...h.segments.map(p=>s(p))].join(", ")})`)}let o=Math.max(4,...e.map(a=>i.find(l=>l.name===a.clip)?.durationS??0));return r.push(`    recordings = world.record(${Math.min(60,Math.ceil(o))}.0)`),t&&r.push("",`recordings[${s(t.name)}].plot_torques().savefig("torques.png")`),r.join(`
`)+`
`}function du(n,e){let t=n.toLowerCase().replace(/[^a-z0-9]+/g,"-").replace(/^[^a-z]+|-+$/g,"").slice(0,48)||"motion";if(!e.includes(t))return t;for(let i=2;;i++)if(!e.includes(`${t}-${i}`))return`${t}-${i}`}async function cp(n){for(let e=0;e<100&&!n();e++)await new Promise(t=>setTimeout(t,30))}async function R0(n,e){let{world:t}=await n.worlds.createWorld({worldId:e?.world??""});if(t){for(let i of e?.figures??[]){let{figure:s}=await n.figures.createFigure({parent:t.name,figureId:i.id,figure:E0(i)});s&&i.clip&&await n.motion.playClip({figure:s.name,clip:`clips/${i.clip}`,loop:!0,reset:!0})}return t.name.slice(7)}}async function w0(n,e,t){let i=[...n.people.values()],s=i.length?Math.min(...i.map(o=>o.figure.placement?.yM??0))-1.2:0,{figure:r}=await n.api.figures.createFigure({parent:n.world?.name??"",figureId:e,figure:{body:t,placement:{yM:s}}});r&&await n.api.motion.playClip({figure:r.name,clip:"clips/idle",loop:!0,reset:!0})}async function T0(n,e,t,i){let s=e.figure,r=s.name.slice(0,s.name.indexOf("/figures/")),{clip:o}=e;await n.api.figures.deleteFigure({name:s.name});let a={body:e.body.name,stepper:s.stepper,controller:s.controller,strength:s.strength,assist:s.assist,fatigueTimeScale:s.fatigueTimeScale,paper:s.paper,placement:s.placement},l={...a,...t.body&&{body:`bodies/${t.body}`},...t.profile&&{body:"",profile:t.profile},...t.stepper&&{stepper:t.stepper}},c;try{c=(await n.api.figures.createFigure({parent:r,figureId:e.name,figure:l})).figure}catch(u){i(Lt(u),!0),c=(await n.api.figures.createFigure({parent:r,figureId:e.name,figure:a})).figure}c&&o&&await n.api.motion.playClip({figure:c.name,clip:o,loop:!0,reset:!0})}var zT=[["Space","pause or resume"],[".","advance one tick (pauses first)"],["S","slow motion on or off"],["R","rewind the world by 5 s, for everyone"],["N","branch: make a new world of the moment that is shown"],["← →  Home  End","with the time line focused: past moments, the oldest, the present; Page keys go to events"],["[  ]","choose the previous or next figure"],["L  K","more or less load"],["P","push the chosen figure as set in the panel"],["U","stand the chosen figure up again"],["Shift R","reset the world"],["T","follow the chosen figure"],["F","fit all figures in the view"],["← → ↑ ↓","turn the view (with the scene focused)"],["+  −","zoom in or out"],["G  E  C  B","show desired motion, joint effort, contact forces, support"],["Esc","cancel a push while dragging; back to the present"]];function C0(){let n=se("table",{},...zT.map(([s,r])=>se("tr",{},se("td",{},...s.split("  ").flatMap(o=>[se("kbd",{},o)," "])),se("td",{},r)))),e=se("p",{},"Drag a figure to push it. Drag beside the figures to turn the view, with the right button to pan, and use the wheel or two fingers to zoom. Drop a BVH file anywhere on the page to play it. Drag the time line to see what was; only Rewind changes the world."),i=se("ul",{class:"key marks","aria-label":"Marks on the time line"},...[["fall","balance lost, fall"],["push","push"],["clip","clip or live motion begins"],["mass","load taken or dropped"],["world","figures, obstacles, rewinds"]].map(([s,r])=>se("li",{},se("i",{class:s}),r)));return[e,n,i]}var XT={ArrowLeft:[-.12,0,1],ArrowRight:[.12,0,1],ArrowUp:[0,.08,1],ArrowDown:[0,-.08,1]};function I0(n){addEventListener("keydown",e=>{if(e.ctrlKey||e.metaKey||e.altKey||n.blocked())return;let t=e.target instanceof HTMLElement?e.target:document.body,i=t.matches("input:not([type=checkbox]):not([type=range]), select, textarea");if(e.key==="Escape"&&n.cancel(),i)return;let s=l=>{e.preventDefault(),l()};if(e.key===" "&&!t.matches("button, summary, a, input:not([type=range])"))return s(n.pause);let r=t.matches("canvas")?XT[e.key]:void 0;if(r)return s(()=>n.turn(...r));let o=e.key.length===1?e.key.toLowerCase():e.key,a=n.keys[e.shiftKey?`shift+${o}`:o]??(o==="r"?void 0:n.keys[o]);a&&s(a)})}function aa(n){try{return localStorage.getItem(n)}catch{return null}}function up(n,e){try{localStorage.setItem(n,e)}catch{}}var ZT=.12,[HT,YT]=[.1,1],N0=5,JT=240,QT=5,la=n=>`${n.toFixed(1)} s`,hu=class{constructor(e,t,i,s,r){this.root=e;this.slider=t;this.marks=i;this.readout=s;this.changed=r;t.addEventListener("input",()=>this.to(t.valueAsNumber/this.rate)),t.addEventListener("keydown",o=>this.key(o)),t.addEventListener("pointerdown",()=>this.held=!0);for(let o of["pointerup","pointercancel","lostpointercapture","change"])t.addEventListener(o,()=>this.held=!1);i.addEventListener("click",o=>{let a=o.target instanceof HTMLElement?o.target.dataset.tick:void 0;a!==void 0&&this.to(Number(a)/this.rate)})}root;slider;marks;readout;changed;shown;past;span={first:0,last:1};held=!1;drawn="";get rate(){return this.past?.rateHz??60}of(e){e!==this.past&&(this.past?.lookAt(void 0),this.past=e,this.drawn="",this.live())}live(){let e=this.shown;this.shown=void 0,this.held=!1,this.past?.lookAt(void 0),this.update(),e!==void 0&&this.changed()}to(e){let{past:t}=this;if(!t||t.oldest<0)return;this.shown===void 0&&(this.span={first:t.oldest,last:t.newest});let{first:i,last:s}=this.span;if(e>=s/this.rate-ZT)return this.live();this.shown=Math.max(e,Math.max(i,t.oldest)/this.rate),t.lookAt(this.shown),this.update(),this.changed()}by(e){this.shown===void 0&&e>0||this.to((this.shown??(this.past?.newest??0)/this.rate)+e)}get tick(){return this.shown===void 0?this.past?.newest??-1:Math.round(this.shown*this.rate)}key(e){let t=e.shiftKey?YT:HT,s={ArrowLeft:()=>this.by(-t),ArrowDown:()=>this.by(-t),ArrowRight:()=>this.by(t),ArrowUp:()=>this.by(t),PageUp:()=>this.toMark(-1),PageDown:()=>this.toMark(1),Home:()=>this.to(-1/0),End:()=>this.live()}[e.key];!s||e.ctrlKey||e.metaKey||e.altKey||(e.preventDefault(),e.stopPropagation(),s())}toMark(e){let{tick:t}=this,i=this.events().map(vn),s=e<0?i.filter(r=>r<t).at(-1):i.find(r=>r>t);s!==void 0?this.to(s/this.rate):e>0&&this.live()}events(){let{first:e,last:t}=this.span,i=s=>vn(s)>=e&&vn(s)<=t&&Ad(s)!==void 0;return(this.past?.events??[]).filter(i).slice(-JT)}update(){let{past:e}=this,t=!!e&&e.oldest>=0&&e.newest>e.oldest;if(this.root.dataset.state=t?this.shown===void 0?"live":"past":"none",this.slider.disabled=!t,!e||!t){this.say("","nothing is held yet"),this.marks.replaceChildren(),this.drawn="";return}this.shown===void 0&&!this.held?this.span={first:e.oldest,last:e.newest}:this.shown!==void 0&&this.shown*this.rate<e.oldest&&(this.shown=e.oldest/this.rate,this.span.first=e.oldest,e.lookAt(this.shown));let{first:i,last:s}=this.span;if(this.slider.min=String(i),this.slider.max=String(Math.max(s,i+1)),(!this.held||this.shown!==void 0)&&(this.slider.value=String(this.shown===void 0?s:this.tick)),this.shown===void 0)this.say("live",`live, ${la(s/this.rate)}`);else{let r=e.newest/this.rate-this.shown;this.say(`−${la(r)}`,`${la(this.shown)}, ${la(r)} before now`)}this.mark()}say(e,t){this.readout.textContent!==e&&(this.readout.textContent=e),this.slider.setAttribute("aria-valuetext",t)}mark(){let{first:e,last:t}=this.span,i=this.marks.clientWidth,s=`${this.past?.version} ${e} ${t} ${i}`;if(s===this.drawn||!i)return;this.drawn=s;let r=new Map,o=this.events().flatMap(a=>{let l=Ad(a),c=(vn(a)-e)/Math.max(1,t-e)*i;if(!l||c-(r.get(l.kind)??-1/0)<QT)return[];r.set(l.kind,c);let u=document.createElement("span");return u.className=l.kind,u.dataset.tick=String(vn(a)),u.title=`${la(a.timeS)}: ${l.text}`,u.style.left=`${(100*c/i).toFixed(2)}%`,[u]});this.marks.replaceChildren(...o)}};var B0="sinew-token";function dp(){let n=new URLSearchParams(location.hash.replace(/^#/,"")),e=n.get("token");if(e!==null){n.delete("token");let t=n.toString();history.replaceState(null,"",t?`#${t}`:location.pathname+location.search),sessionStorage.setItem(B0,e)}return sessionStorage.getItem(B0)??""}function Te(n,e){let t=document.getElementById(n);if(!(t instanceof e))throw new Error(`the page has no ${n}`);return t}var[KT,qT,Gr]=[Te("bar",HTMLElement),Te("stage",HTMLElement),Te("view",HTMLCanvasElement)],[da,vp,us]=[Te("pause",HTMLButtonElement),Te("step",HTMLButtonElement),Te("speed",HTMLSelectElement)],[L0,Sp]=[Te("state",HTMLElement),Te("dialog",HTMLDialogElement)],ha=Te("world",HTMLSelectElement),k0=Te("panel-toggle",HTMLButtonElement),[_p,W0]=[Te("reset",HTMLButtonElement),Te("follow",HTMLButtonElement)],z0=dp(),dn=lp(location.hash),Vr={ghost:!0,forces:!0,support:!0,effort:!0};for(let n of dn.hide)n in Vr&&(Vr[n]=!1);var ut,gp=!1,Us=dn.figure,fu,Dr=()=>performance.now()/1e3,gu=new ru(Te("captions",HTMLElement)),Pt=(n,e=!1)=>gu.say(n,Dr(),e),Jn=n=>{n.catch(e=>Pt(Lt(e),!0))},F0=Promise.resolve();function pa(n){It.live();let e=F0.then(n);F0=e.catch(()=>{}),Jn(e)}function ca(n){if(!ut)return Pt("Choose a figure first.");X0(ut.name,n)}function X0(n,e){pa(async()=>{let t=re.person(n);t&&await e(t)})}var jT=new cu(Te("fallen",HTMLElement),n=>X0(n,e=>re.standUp(e))),Ep=new Nr,re=new Ur(new el(location.origin,Ed(location.origin,z0)),n=>{n==="phase"&&Q0(re.phase),n==="roster"&&e1(),n==="world"&&n1(),n==="lists"&&t1()},n=>{It.shown===void 0&&gu.event(n,Dr())},n=>{fu=n,re.world&&Ep.follow(re.api,re.world.name,n)});async function Z0(n,{person:e,segment:t,local:i,impulse:s}){await n.api.perturbations.applyPerturbations({world:n.world?.name??"",perturbations:[{figureId:e.name,kind:{case:"impulse",value:{segment:t,pointM:{x:i.x,y:i.y,z:i.z},impulseNewtonSeconds:{x:s.x,y:s.y,z:s.z},durationS:.1}}}]}),Pt(`Pushed ${e.name}: ${s.length().toFixed(0)} N·s`)}var H0=new Js(Te("labels",HTMLElement)),xt;try{xt=new Lr(Gr,{choose:n=>bu(n&&re.person(n.name)),pushing:(n,e,t)=>H0.push=n?{text:`${n.impulse.length().toFixed(0)} N·s`,x:e,y:t}:void 0,push:n=>Jn(Z0(re,n)),following:n=>{W0.setAttribute("aria-pressed",String(n)),Fn()}}),xt.add(Ep.group)}catch{Gr.hidden=Te("view-tools",HTMLElement).hidden=!0,qT.append(se("section",{class:"plain"},se("h2",{},"No 3D view"),se("p",{},"This browser does not provide WebGL. The controls and readouts in the panel still work.")))}var Wi=new au(Te("controls",HTMLElement),re,{choose:bu,say:Pt,forChosen:ca,play:n=>ca(e=>s1(e,n)),rebuild:n=>ca(e=>r1(e,n)),add:()=>pa(Mp),open:n=>pa(()=>j0(n)),copy:o1,shown:Fn},Vr),Yn=new Qs(Te("load-slider",HTMLInputElement),Te("load-value",HTMLOutputElement),re,{change:()=>It.live(),done:Fn,failed:n=>Pt(Lt(n),!0)}),It=new hu(Te("timeline",HTMLElement),Te("time",HTMLInputElement),Te("marks",HTMLElement),Te("moment",HTMLOutputElement),()=>{document.body.dataset.time=It.shown===void 0?"live":"past";for(let n of[xt,Qn.scene])n&&(n.pushable=It.shown===void 0)}),$T=new js(re),Qn=new iu(re.api,{pane:Te("beside",HTMLElement),canvas:Te("beside-view",HTMLCanvasElement),labels:Te("beside-labels",HTMLElement),slider:Te("beside-load",HTMLInputElement),output:Te("beside-load-value",HTMLOutputElement),pause:Te("beside-pause",HTMLButtonElement),push:Te("beside-push",HTMLButtonElement)},{say:Pt,choose:n=>bu(re.person(n)),push:n=>{let e=n.person(ut?.name??"")??[...n.people.values()][0];e&&Jn(Wi.push(e,n))},drawn:(n,e)=>Jn(Z0(n,e)),gone:()=>Ut.leave()}),Ut=new lu(re,Qn,{strip:Te("compare",HTMLElement),since:Te("since",HTMLOutputElement),lag:Te("lag",HTMLElement),catchUp:Te("catch-up",HTMLButtonElement),swap:Te("swap",HTMLButtonElement),done:Te("compare-done",HTMLButtonElement),mainHeader:Te("main-header",HTMLElement),mainTitle:Te("main-title",HTMLElement),besideTitle:Te("beside-title",HTMLElement)},{say:Pt,ask:(n,...e)=>(Tp(n,...e),()=>Sp.close()),show:n=>{fa=!0,re.show(n)},changed:()=>{Ut.pair&&innerWidth<=900&&Rp(!1),Fn()}}),yu=!1;for(let[n,e]of[[Gr,!1],[Te("beside-view",HTMLCanvasElement),!0]])for(let t of["pointerdown","wheel"])n.addEventListener(t,()=>yu=e,{capture:!0,passive:!0});async function Y0(){let{past:n,world:e}=re;if(!n||!e||n.oldest<0)return Pt("Nothing of the past is held here.");let t=c0(await re.roles());if(t)return Pt(t,!0);let i=Math.max(n.oldest,Math.round(It.tick-N0*n.rateHz));await re.api.history.seekWorld({name:e.name,tick:BigInt(i)}),It.live(),await re.refresh(),Pt(`The world was rewound to ${(i/n.rateHz).toFixed(1)} s`)}async function J0(){let{past:n,world:e}=re;if(!n||!e)return;let t=u0(await re.roles());if(t)return Pt(t,!0);let i=e.name.slice(7),{worlds:s}=await re.api.worlds.listWorlds({pageSize:1e3}),r=du(`${i}-branch`,s.map(a=>a.name.slice(7))),o=await d0(re,It.shown===void 0?void 0:It.tick,r);Ut.leave(),It.live(),Ut.begin(o)}var hp=!1;function mu(n){hp||(hp=!0,Jn(n().finally(()=>hp=!1)))}Te("rewind",HTMLButtonElement).addEventListener("click",()=>mu(Y0));Te("branch",HTMLButtonElement).addEventListener("click",()=>mu(J0));Te("to-live",HTMLButtonElement).addEventListener("click",()=>{It.live(),Te("time",HTMLInputElement).focus()});function bu(n){ut=n,Us=n?.name??"",Wi.lists(n),Fn()}function e1(){xp=void 0,ut=re.person(Us)??(gp?ut:[...re.people.values()][0]),Wi.lists(ut),Te("load",HTMLElement).hidden=!re.people.size,K0()}function t1(){let n=re.worlds.map(e=>e.name.slice(7));ha.replaceChildren(...n.map(e=>se("option",{value:e},e))),ha.hidden=n.length<2,Wi.lists(ut)}function n1(){let n=re.world?.name.slice(7)??"";It.of(re.past),Ut.pair&&n&&n!==Ut.pair.branch&&n!==Ut.pair.original&&Ut.leave(),ha.value=n,da.textContent=re.paused?"Resume":"Pause",da.setAttribute("aria-pressed",String(re.paused));let e=String(re.world?.speed??1);[...us.options].some(t=>t.value===e)&&(us.value=e),Fn()}function Q0(n){n.kind==="error"&&(fu=void 0,Ut.leave()),It.of(re.past),L0.dataset.kind=n.kind,L0.hidden=n.kind==="live",document.body.dataset.phase=n.kind;let e={connecting:["Connecting","Waiting for the first frame."],live:["",""],empty:re.world?["No figures yet","This world is empty. Add a figure, or drop a BVH file on the page."]:["No world yet","The server is running but has no world. Create one here or from a client; it will appear by itself."],reconnecting:["Connection lost","The viewer reconnects by itself as soon as the server is back."],error:["Something went wrong",n.kind==="error"?n.text:""]},[t,i]=e[n.kind];for(let[l,c]of[["state-title",t],["state-text",i]]){let u=Te(l,HTMLElement);u.textContent!==c&&(u.textContent=c)}let s=[],r=(l,c)=>{let u=se("button",{type:"button",class:s.length?"":"main"},l);u.addEventListener("click",c),s.push(u)};if(n.kind==="empty"&&re.world&&r("Add a figure",()=>Jn(Mp())),n.kind==="empty"&&!re.world&&r("Create a world",()=>Jn(yp())),n.kind==="error"){dn.figures.length&&dn.world&&r("Create it from this link",()=>Jn(yp(dn)));for(let l of re.worlds.slice(0,4)){let c=l.name.slice(7);r(`Show “${c}”`,()=>re.show(c))}r("Try again",()=>re.show(dn.world))}let o=Te("state-actions",HTMLElement),a=l=>[...l].map(c=>c.textContent).join(`
`);a(o.children)!==a(s)&&o.replaceChildren(...s);for(let l of[da,vp,us,_p])l.disabled=n.kind!=="live"&&!(n.kind==="empty"&&re.world);Yn.enable(n.kind==="live"),n.kind==="live"&&K0()}async function yp(n){let e=await R0(re.api,n);e&&re.show(e)}var fa=!1;function K0(){fa||re.phase.kind!=="live"||!re.people.size||(fa=!0,xt&&(xt.place=dn.camera,xt.follow=dn.follow),dn.load!==void 0&&dn.load!==Yn.mass&&!dn.beside?Yn.set(dn.load):Yn.read())}async function i1(){await Yn.none();let n=await re.reset();Yn.gone(),await re.refresh(),Fn(),n.length?Pt(`Not reset: ${n.join("; ")}`,!0):Pt("World reset: all figures are back at their start, without loads")}_p.addEventListener("click",()=>pa(i1));async function s1(n,e){e&&(await re.api.motion.playClip({figure:n.figure.name,clip:`clips/${e}`,loop:!0}),await re.refresh(),await q0(n),Pt(`${n.name} plays “${e}”`),Fn())}async function q0(n){let e=n.loadKg();e>0&&await re.carry([n],e)}async function j0(n){ut||await Mp();let e=ut;if(e){Pt(`Reading ${n.name}`);try{let t=du(n.name.replace(/\.bvh$/i,""),re.clips),i=new Uint8Array(await n.arrayBuffer()),{clip:s}=await re.api.motion.createClip({clipId:t,displayName:n.name.slice(0,100),body:e.body.name,source:{case:"bvh",value:{data:i}}});await re.lists(),await re.api.motion.playClip({figure:e.figure.name,clip:s?.name??"",loop:!0,reset:!0}),await re.refresh(),await q0(e),Wi.showReport(n.name,s?.report,void 0,s?.forecast),Pt(`${e.name} plays ${n.name}`),Fn()}catch(t){Wi.showReport(n.name,void 0,Lt(t)),Pt(`${n.name}: ${Lt(t)}`,!0)}}}var Ap=Te("drop",HTMLElement),ua=0;addEventListener("dragenter",n=>{n.dataTransfer?.types.includes("Files")&&(ua++,Ap.hidden=!1)});addEventListener("dragleave",()=>{ua=Math.max(0,ua-1),ua||(Ap.hidden=!0)});addEventListener("dragover",n=>n.preventDefault());addEventListener("drop",n=>{n.preventDefault(),ua=0,Ap.hidden=!0;let[e]=n.dataTransfer?.files??[];e&&pa(()=>j0(e))});async function Mp(){if(!re.world)return yp();let n=[...re.people.values()].map(e=>e.name);Us=du("figure",n),await w0(re,Us,ut?.body.name??"bodies/adult-man"),await cp(()=>ut?.name===Us),await re.refresh()}async function r1(n,e){gp=!0;try{let t=n.loadKg();Us=n.name,await T0(re,n,e,Pt),await cp(()=>ut!==n&&ut?.name===n.name),ut&&t>0&&await re.carry([ut],t),await re.refresh(),Fn()}finally{gp=!1}}function $0(n){return _0({world:Ut.pair?.branch??re.world?.name.slice(7)??dn.world,figure:ut?.name??"",load:Yn.mass||void 0,hide:Object.entries(Vr).flatMap(([e,t])=>t?[]:[e]),camera:xt?.place,follow:xt?.follow??!1,figures:n?[...re.people.values()].map(uu):[],beside:Ut.pair?.original??"",since:Ut.pair?.since??0})}var U0=0;function Fn(){re.phase.kind==="live"&&(clearTimeout(U0),U0=window.setTimeout(()=>history.replaceState(null,"",`#${$0(re.people.size<=8)}`),150))}Gr.addEventListener("pointerup",Fn);Gr.addEventListener("wheel",Fn,{passive:!0});addEventListener("hashchange",()=>{if(!(location.hash&&!location.hash.includes("="))){if(dp()!==z0)return location.reload();dn=lp(location.hash),Us=dn.figure,fa=!1,ex()}});function ex(){let{world:n,beside:e,since:t}=dn;Ut.leave(),n&&e&&n!==e?Ut.begin({branch:n,original:e,since:t}):re.show(n)}function o1(n){let e=n==="link"?`${location.origin}/#${$0(!0)}`:n==="cli"?ut?A0(ut,re.motions):"":M0(location.host,[...re.people.values()],ut,re.motions),t=()=>Tp("Copy this text",se("pre",{class:"copied",tabindex:"0"},e));if(!navigator.clipboard)return t();navigator.clipboard.writeText(e).then(()=>Pt(`Copied: ${e.split(`
`)[0].slice(0,60)}`),t)}da.addEventListener("click",()=>Jn(re.setPaused(!re.paused)));vp.addEventListener("click",()=>{It.live(),Jn(re.step())});us.addEventListener("change",()=>Jn(re.setSpeed(Number(us.value))));ha.addEventListener("change",()=>{fa=!0,Ut.leave(),re.show(ha.value)});function Rp(n){document.body.classList.toggle("closed",!n),k0.setAttribute("aria-expanded",String(n))}k0.addEventListener("click",()=>Rp(document.body.classList.contains("closed")));innerWidth<=900&&Rp(!1);var bp=matchMedia("(prefers-color-scheme: dark)");function wp(n){document.documentElement.dataset.theme=n?"dark":"light",xt?.theme(n),Qn.theme(n)}wp(aa("sinew-theme")?aa("sinew-theme")==="dark":bp.matches);bp.addEventListener("change",()=>aa("sinew-theme")??wp(bp.matches));Te("theme",HTMLButtonElement).addEventListener("click",()=>{let n=document.documentElement.dataset.theme!=="dark";wp(n),up("sinew-theme",n?"dark":"light")});function Tp(n,...e){Te("dialog-title",HTMLElement).textContent=n,Te("dialog-body",HTMLElement).replaceChildren(...e),Sp.showModal()}function tx(){Tp("Help",...C0())}Te("help",HTMLButtonElement).addEventListener("click",tx);var nx=Te("hint",HTMLElement);nx.hidden=aa("sinew-hint")==="dismissed";Te("hint-close",HTMLButtonElement).addEventListener("click",()=>{nx.hidden=!0,up("sinew-hint","dismissed"),Gr.focus({preventScroll:!0})});function ix(){if(xt){if(!xt.follow&&!ut)return Pt("Choose a figure first.");xt.follow=!xt.follow}}W0.addEventListener("click",ix);Te("fit",HTMLButtonElement).addEventListener("click",()=>xt?.recentre());function pu(n){document.getElementById(`show-${n}`)?.click()}function P0(n){let e=[...re.people.values()];e.length&&bu(e[(e.indexOf(ut)+n+e.length)%e.length])}function pp(n){yu=!1,xt?.turn(0,0,n)}I0({blocked:()=>Sp.open,pause:()=>da.click(),cancel:()=>{xt?.release(!1),Qn.scene?.release(!1),It.live()},turn:(...n)=>{yu=!1,xt?.turn(...n),Fn()},keys:{".":()=>vp.click(),"[":()=>P0(-1),"]":()=>P0(1),l:()=>Yn.set(Yn.mass+1),k:()=>Yn.set(Yn.mass-1),p:()=>ca(n=>Wi.push(n)),r:()=>mu(Y0),n:()=>mu(J0),u:()=>ca(n=>re.standUp(n)),"shift+r":()=>_p.click(),t:ix,s:()=>{us.value=us.value==="1"?"0.25":"1",Jn(re.setSpeed(Number(us.value)))},"+":()=>pp(.88),"=":()=>pp(.88),"-":()=>pp(1.14),f:()=>xt?.recentre(),g:()=>pu("ghost"),e:()=>pu("effort"),c:()=>pu("forces"),b:()=>pu("support"),"?":tx}});var fp=0,mp=0,D0=0,G0=0,V0=0,a1=.04,O0=0,xp;function l1(n){let e=re.playhead.at(n,re.paused?1:re.world?.speed??1);return e&&{...e,time:ao(e),people:re.people,exact:!0}}function c1(n){let e=l1(n),t=Qn.open?Qn.live(n):void 0,i=ut?.name??"",s=Ut.time(e,t),r=It.shown??(Ut.pair&&!Ut.mainIsBranch?s:void 0),o=It.shown??(Ut.mainIsBranch?s:void 0);return[r===void 0?e:$T.at(r,i),o===void 0?t:Qn.past(o,i)]}function u1(n,e){let t=It.shown;Yn.read(),Qn.open&&Qn.read(),It.update(),Ut.update(n?.time);let i=t===void 0||n?.exact?"":re.past?.trouble;i&&gu.say(i,e,!0)}function sx(){requestAnimationFrame(sx);let n=Dr();if(n<O0)return;let[e,t]=c1(n),i=e?.people??re.people;xp!==i&&(xt?.populate(i.values()),xp=i);let s=ut&&(i.get(ut.index)?.name===ut.name?i.get(ut.index):void 0);Wi.view(s),xt?.prepare(e&&{before:Hi(e.before),after:Hi(e.after),share:e.share},Vr,s),e&&Ep.place(e.before,e.after,e.share),e&&V0!==re.people.size&&(V0=re.people.size,xt?.frameAllOnce());let r=["live","reconnecting"].includes(re.phase.kind);if(H0.update(r?i.values():[],ut?.name,xt),n-G0>.066){G0=n;let l=n-D0>.25;l&&(D0=n),Wi.update(n,l),l&&u1(e,n);let c=e?.time??0;gu.update(i.values(),It.shown===void 0?fu?.timeS??0:c,n),jT.update(It.shown===void 0?i.values():[],p=>re.says(p,"FALLEN"),ut);let u=`${(i===re.people?fu?.timeS??0:c).toFixed(1)} s`,h=Te("clock",HTMLOutputElement);h.textContent!==u&&(h.textContent=u)}let o=(Dr()-n)*1e3;xt?.draw3d(),Qn.open&&xt&&Qn.draw(t,Vr,ut?.name,xt,yu);let a=Dr()-n;a>a1&&(O0=n+2*Math.min(a,.5)),fp+=.05*(o-fp),mp+=.05*((Dr()-n)*1e3-mp),document.body.dataset.script=fp.toFixed(2),document.body.dataset.drawn=String(xt?.drawn??0),document.body.dataset.cost=mp.toFixed(2),document.body.dataset.shown=`${e?.time.toFixed(2)} ${e?.exact}`,document.body.dataset.beside=Qn.open?`${t?.time.toFixed(2)} ${t?.exact}`:""}KT.dataset.ready="true";Q0(re.phase);ex();requestAnimationFrame(sx);
/*! Bundled license information:

three/build/three.core.js:
three/build/three.module.js:
  (**
   * @license
   * Copyright 2010-2026 Three.js Authors
   * SPDX-License-Identifier: MIT
   *)
*/
